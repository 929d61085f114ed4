// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/devices/movewishes.h"

#include "ui/common/texts.h"

#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <set>

namespace dynascope {
namespace {

enum Column { DeviceColumn, IdColumn, BaudColumn, NewIdColumn, NewBaudColumn, Columns };

std::set<int> ratesOf(const Device &device, const std::function<bool(int)> &offers)
{
    std::set<int> rates{device.baudRate()};
    for (const BaudCode &code : device.table().description().baudCodes) {
        if (offers(code.rate))
            rates.insert(code.rate);
    }
    return rates;
}

void fill(QComboBox &combo, const std::set<int> &rates, int chosen)
{
    const QSignalBlocker blocker(combo);
    std::set<int> present;
    for (int i = 0; i < combo.count(); ++i)
        present.insert(combo.itemData(i).toInt());
    if (present == rates) // it may be open
        return;
    combo.clear();
    for (const int rate : rates)
        combo.addItem(baudText(rate), rate);
    combo.setCurrentIndex(std::max(0, combo.findData(chosen)));
}

} // namespace

MoveWishes::MoveWishes(QWidget *parent)
    : QWidget(parent)
    , m_first(new QSpinBox(this))
    , m_number(new QPushButton(tr("&Number Upward"), this))
    , m_baud(new QComboBox(this))
    , m_allToBaud(new QPushButton(tr("All to &Baud"), this))
    , m_swap(new QPushButton(tr("&Swap IDs"), this))
    , m_table(new QTableWidget(0, Columns, this))
{
    m_helpers = makeHelpers();
    makeTable();
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(8);
    layout->addWidget(m_helpers);
    layout->addWidget(m_table, 1);
}

QWidget *MoveWishes::makeHelpers()
{
    auto *helpers = new QWidget(this);
    auto *row = new QHBoxLayout(helpers);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(8);
    m_first->setObjectName(QStringLiteral("firstId"));
    m_first->setAccessibleName(tr("First ID"));
    m_first->setRange(0, MaximumId);
    m_first->setValue(1);
    m_first->setPrefix(tr("from "));
    m_number->setObjectName(QStringLiteral("numberButton"));
    m_number->setToolTip(tr("Give the selected rows, or all, IDs one after the other"));
    m_baud->setObjectName(QStringLiteral("allBaud"));
    m_baud->setAccessibleName(tr("Baud rate for all"));
    m_baud->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    m_allToBaud->setObjectName(QStringLiteral("allToBaudButton"));
    m_allToBaud->setToolTip(tr("Give the selected rows, or all, this baud rate, where the model offers it"));
    m_swap->setObjectName(QStringLiteral("swapButton"));
    for (QPushButton *button : {m_number, m_allToBaud, m_swap})
        button->setAutoDefault(false);
    row->addWidget(m_number);
    row->addWidget(m_first);
    row->addSpacing(8);
    row->addWidget(m_allToBaud);
    row->addWidget(m_baud);
    row->addSpacing(8);
    row->addWidget(m_swap);
    row->addStretch(1);
    connect(m_number, &QPushButton::clicked, this, &MoveWishes::number);
    connect(m_allToBaud, &QPushButton::clicked, this, &MoveWishes::allToBaud);
    connect(m_swap, &QPushButton::clicked, this, &MoveWishes::swap);
    return helpers;
}

void MoveWishes::makeTable()
{
    m_table->setObjectName(QStringLiteral("moveTable"));
    m_table->setAccessibleName(tr("Devices and their new places"));
    m_table->setHorizontalHeaderLabels({tr("Device"), tr("ID"), tr("Baud rate"), tr("New ID"), tr("New baud rate")});
    m_table->setSelectionBehavior(QAbstractItemView::SelectRows);
    m_table->setSelectionMode(QAbstractItemView::ExtendedSelection);
    m_table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_table->setTabKeyNavigation(false);
    m_table->setShowGrid(false);
    m_table->setWordWrap(false);
    m_table->setTextElideMode(Qt::ElideMiddle);
    m_table->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
    m_table->verticalHeader()->hide();
    m_table->verticalHeader()->setDefaultSectionSize(m_first->sizeHint().height() + 4);
    QHeaderView *header = m_table->horizontalHeader();
    header->setHighlightSections(false);
    header->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    header->setSectionResizeMode(DeviceColumn, QHeaderView::Stretch);
    const QFontMetrics metrics = fontMetrics();
    for (const auto &[column, text] :
         {std::pair{IdColumn, "ID 000"}, std::pair{BaudColumn, "57 600 bps 00"}, std::pair{NewIdColumn, "New ID 00"},
          std::pair{NewBaudColumn, "115 200 bps 000"}})
        m_table->setColumnWidth(column, metrics.horizontalAdvance(QLatin1String(text)) + 16);
    connect(m_table, &QTableWidget::itemSelectionChanged, this, &MoveWishes::updateHelpers);
}

void MoveWishes::setText(int row, int column, const QString &text)
{
    QTableWidgetItem *item = m_table->item(row, column);
    if (!item) {
        item = new QTableWidgetItem;
        m_table->setItem(row, column, item);
    }
    item->setText(text);
    if (column == DeviceColumn)
        item->setToolTip(plainToolTip(text));
}

void MoveWishes::setDevices(const std::vector<const Device *> &devices, const std::function<bool(int)> &offers)
{
    const bool isSame = std::ranges::equal(devices, m_rows, {}, &Device::key, &Row::key);
    if (!isSame) {
        const std::map<DeviceKey, MovePlace> wished = wishes();
        m_rows.clear();
        m_table->setRowCount(0);
        for (const Device *device : devices) {
            addRow(*device, offers);
            const auto old = wished.find(device->key());
            if (old != wished.end())
                m_rows.back().id->setValue(old->second.id);
        }
    }
    std::set<int> all;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const Device &device = *devices[i];
        const auto row = static_cast<int>(i);
        setText(row, DeviceColumn, device.displayName());
        setText(row, IdColumn, QString::number(device.id()));
        setText(row, BaudColumn, baudText(device.baudRate()));
        const std::set<int> rates = ratesOf(device, offers);
        all.insert(rates.begin(), rates.end());
        const QVariant wished = m_rows[i].baud->currentData();
        fill(*m_rows[i].baud, rates, wished.isValid() ? wished.toInt() : device.baudRate());
    }
    fill(*m_baud, all, m_baud->count() > 0 ? m_baud->currentData().toInt() : 1'000'000);
    setFixed(false);
    updateHelpers();
}

void MoveWishes::addRow(const Device &device, const std::function<bool(int)> &offers)
{
    const int row = m_table->rowCount();
    m_table->insertRow(row);
    auto *id = new QSpinBox(m_table);
    id->setRange(0, MaximumId);
    id->setValue(device.id());
    id->setObjectName(QStringLiteral("newId%1").arg(row));
    id->setAccessibleName(tr("New ID of %1").arg(device.displayName()));
    auto *baud = new QComboBox(m_table);
    fill(*baud, ratesOf(device, offers), device.baudRate());
    baud->setObjectName(QStringLiteral("newBaud%1").arg(row));
    baud->setAccessibleName(tr("New baud rate of %1").arg(device.displayName()));
    for (QWidget *editor : {static_cast<QWidget *>(id), static_cast<QWidget *>(baud)}) {
        editor->setFocusPolicy(Qt::StrongFocus);
        editor->installEventFilter(this);
    }
    id->setEnabled(device.isKnownModel());
    baud->setEnabled(device.isKnownModel());
    m_table->setCellWidget(row, NewIdColumn, id);
    m_table->setCellWidget(row, NewBaudColumn, baud);
    if (!m_rows.empty())
        setTabOrder(m_rows.back().baud, id);
    setTabOrder(id, baud);
    const auto chosenHere = [this] {
        m_leftOut.clear();
        emit changed();
    };
    connect(id, &QSpinBox::valueChanged, this, chosenHere);
    connect(baud, &QComboBox::currentIndexChanged, this, chosenHere);
    m_rows.push_back({device.key(), id, baud});
}

/// The wheel scrolls the table: over an editor that hasn't the focus it would renumber somebody. And who types into an
/// editor has selected nobody: the buttons above are about all rows.
bool MoveWishes::eventFilter(QObject *watched, QEvent *event)
{
    const auto *editor = qobject_cast<QWidget *>(watched);
    if (event->type() == QEvent::Wheel && editor && !editor->hasFocus()) {
        event->ignore();
        return true;
    }
    if (event->type() == QEvent::FocusIn)
        QMetaObject::invokeMethod(m_table, &QTableWidget::clearSelection, Qt::QueuedConnection); // the view selects it
    return QWidget::eventFilter(watched, event);
}

void MoveWishes::showPlan(const MovePlan &plan)
{
    std::set<std::size_t> movers;
    for (const MoveStep &step : plan.steps)
        movers.insert(step.device);
    if (!m_rows.empty() || m_table->rowCount() != static_cast<int>(movers.size())) {
        m_rows.clear();
        m_table->setRowCount(0);
        m_table->setRowCount(static_cast<int>(movers.size()));
    }
    int row = 0;
    for (const std::size_t mover : movers) {
        const MoveDevice &device = plan.devices[mover];
        const MovePlace place = plan.placeOf(mover);
        setText(row, DeviceColumn, device.place.name);
        setText(row, IdColumn, QString::number(place.id));
        setText(row, BaudColumn, baudText(place.baudRate));
        setText(row, NewIdColumn, QString::number(device.goal.id));
        setText(row++, NewBaudColumn, baudText(device.goal.baudRate));
    }
    setFixed(true);
}

void MoveWishes::setFixed(bool fixed)
{
    m_helpers->setVisible(!fixed);
}

std::map<DeviceKey, MovePlace> MoveWishes::wishes() const
{
    std::map<DeviceKey, MovePlace> wishes;
    for (const Row &row : m_rows)
        wishes[row.key] = {row.baud->currentData().toInt(), row.id->value()};
    return wishes;
}

std::vector<std::size_t> MoveWishes::chosen() const
{
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        if (m_table->selectionModel()->isRowSelected(static_cast<int>(i)))
            rows.push_back(i);
    }
    if (rows.empty()) {
        for (std::size_t i = 0; i < m_rows.size(); ++i)
            rows.push_back(i);
    }
    return rows;
}

void MoveWishes::number()
{
    int next = m_first->value();
    for (const std::size_t row : chosen()) {
        const QSignalBlocker blocker(m_rows[row].id);
        if (m_rows[row].id->isEnabled())
            m_rows[row].id->setValue(next++);
    }
    emit changed();
}

void MoveWishes::allToBaud()
{
    QStringList left;
    for (const std::size_t row : chosen()) {
        const QSignalBlocker blocker(m_rows[row].baud);
        const int at = m_rows[row].baud->findData(m_baud->currentData());
        if (at >= 0 && m_rows[row].baud->isEnabled())
            m_rows[row].baud->setCurrentIndex(at);
        else
            left << m_table->item(static_cast<int>(row), DeviceColumn)->text();
    }
    m_leftOut = left.isEmpty() ? QString()
               : left.size() == 1
                   ? tr("%1 can't work at %2 and is left where it is.").arg(left.front(), m_baud->currentText())
                   : tr("%1 can't work at %2 and are left where they are.").arg(left.join(tr(", ")), m_baud->currentText());
    emit changed();
}

void MoveWishes::swap()
{
    const std::vector<std::size_t> rows = chosen();
    if (rows.size() != 2)
        return;
    const QSignalBlocker one(m_rows[rows[0]].id), other(m_rows[rows[1]].id);
    const int id = m_rows[rows[0]].id->value();
    m_rows[rows[0]].id->setValue(m_rows[rows[1]].id->value());
    m_rows[rows[1]].id->setValue(id);
    emit changed();
}

void MoveWishes::updateHelpers()
{
    const bool two = chosen().size() == 2;
    m_swap->setEnabled(two);
    m_swap->setToolTip(two ? tr("Exchange the new IDs of the two") : tr("Select two rows first"));
}

} // namespace dynascope
