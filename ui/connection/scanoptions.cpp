// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/connection/scanoptions.h"

#include "ui/common/texts.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSpinBox>

#include <algorithm>

namespace dynascope {

namespace {

constexpr int BaudRole = Qt::UserRole;
constexpr double SecondsPerId = 0.003; ///< a broadcast Ping waits this long per absent ID (protocol, section 4)

QSpinBox *idSpin(const QString &name, int value, QWidget *parent)
{
    auto *spin = new QSpinBox(parent);
    spin->setObjectName(name);
    spin->setRange(0, 252);
    spin->setValue(value);
    return spin;
}

} // namespace

ScanOptions::ScanOptions(QWidget *parent)
    : QFrame(parent, Qt::Popup)
    , m_rates(new QWidget(this))
    , m_bauds(new QListWidget(m_rates))
    , m_firstId(idSpin(QStringLiteral("scanFirstId"), 0, this))
    , m_lastId(idSpin(QStringLiteral("scanLastId"), 252, this))
    , m_sweep(new QCheckBox(tr("Ask every ID by itself (slow)"), this))
    , m_summary(new QLabel(this))
    , m_scan(new QPushButton(tr("Scan"), this))
{
    setObjectName(QStringLiteral("scanOptions"));
    setFrameShape(QFrame::StyledPanel);
    m_bauds->setObjectName(QStringLiteral("scanBauds"));
    m_bauds->setAccessibleName(tr("Baud rates to scan"));
    m_firstId->setAccessibleName(tr("First ID"));
    m_lastId->setAccessibleName(tr("Last ID"));
    m_sweep->setObjectName(QStringLiteral("scanSweep"));
    m_sweep->setToolTip(
        tr("For a bus on which a Ping to all at once brings nothing readable, as with an adapter that mixes "
           "the answers up. Each ID that nobody has costs a whole waiting time."));
    m_scan->setObjectName(QStringLiteral("scanStart"));
    m_scan->setDefault(true);
    for (const int baud : allBauds()) {
        auto *item = new QListWidgetItem(baudText(baud), m_bauds);
        item->setData(BaudRole, baud);
        item->setSizeHint(QSize(0, fontMetrics().height() + 8));
        item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsUserCheckable | Qt::ItemIsSelectable);
    }
    setBauds(likelyBauds(0));
    m_bauds->setFixedHeight(m_bauds->sizeHintForRow(0) * m_bauds->count() + 8);
    m_bauds->setMinimumWidth(200);

    build();
    connect(m_bauds, &QListWidget::itemChanged, this, &ScanOptions::update);
    connect(m_firstId, &QSpinBox::valueChanged, this, [this](int first) {
        m_lastId->setMinimum(first);
        update();
    });
    connect(m_lastId, &QSpinBox::valueChanged, this, &ScanOptions::update);
    connect(m_scan, &QPushButton::clicked, this, [this] {
        hide();
        emit scanRequested();
    });
    update();
}

void ScanOptions::build()
{
    auto *likely = new QPushButton(tr("Likely"), m_rates);
    auto *all = new QPushButton(tr("All"), m_rates);
    auto *none = new QPushButton(tr("None"), m_rates);
    likely->setToolTip(tr("The rates a servo with a standard setting can have"));
    connect(likely, &QPushButton::clicked, this, [this] { setBauds(likelyBauds(0)); });
    connect(all, &QPushButton::clicked, this, [this] { setBauds(allBauds()); });
    connect(none, &QPushButton::clicked, this, [this] { setBauds({}); });
    auto *rates = new QVBoxLayout(m_rates);
    rates->setContentsMargins(0, 0, 0, 8);
    rates->setSpacing(8);
    auto *choices = new QHBoxLayout;
    for (QPushButton *button : {likely, all, none})
        choices->addWidget(button);

    auto *ids = new QHBoxLayout;
    ids->addWidget(new QLabel(tr("IDs"), this));
    ids->addWidget(m_firstId);
    ids->addWidget(new QLabel(tr("to"), this));
    ids->addWidget(m_lastId);
    ids->addStretch(1);

    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(16, 16, 16, 16);
    layout->setSpacing(8);
    rates->addWidget(new QLabel(tr("Baud rates"), m_rates));
    rates->addWidget(m_bauds);
    rates->addLayout(choices);
    layout->addWidget(m_rates);
    layout->addLayout(ids);
    layout->addWidget(m_sweep);
    layout->addWidget(m_summary);
    layout->addWidget(m_scan);
}

void ScanOptions::popup(const QPoint &position)
{
    adjustSize();
    move(position);
    show();
    m_scan->setFocus();
}

void ScanOptions::setRatesOffered(bool offered)
{
    if (m_rates->isVisibleTo(this) == offered)
        return;
    m_rates->setVisible(offered);
    update();
}

std::vector<int> ScanOptions::checkedBauds() const
{
    std::vector<int> bauds;
    for (int row = 0; row < m_bauds->count(); ++row) {
        if (m_bauds->item(row)->checkState() == Qt::Checked)
            bauds.push_back(m_bauds->item(row)->data(BaudRole).toInt());
    }
    return bauds;
}

ScanRange ScanOptions::range(int lastUsedBaud) const
{
    const std::vector<int> order = likelyBauds(lastUsedBaud);
    const auto rank = [&order](int baud) { return std::ranges::find(order, baud) - order.begin(); };
    ScanRange range;
    range.sweep = m_sweep->isChecked();
    range.bauds = m_rates->isVisibleTo(this) ? checkedBauds() : std::vector{lastUsedBaud};
    // A line may work at a rate that is in no list; it is the likeliest of all.
    if (lastUsedBaud > 0 && m_rates->isVisibleTo(this)
        && std::ranges::find(allBauds(), lastUsedBaud) == allBauds().end())
        range.bauds.push_back(lastUsedBaud);
    std::ranges::stable_sort(range.bauds, {}, rank);
    range.firstId = m_firstId->value();
    range.lastId = m_lastId->value();
    return range;
}

void ScanOptions::setBauds(const std::vector<int> &bauds)
{
    for (int row = 0; row < m_bauds->count(); ++row) {
        QListWidgetItem *item = m_bauds->item(row);
        const bool wanted = std::ranges::find(bauds, item->data(BaudRole).toInt()) != bauds.end();
        item->setCheckState(wanted ? Qt::Checked : Qt::Unchecked);
    }
}

void ScanOptions::update()
{
    const auto count = m_rates->isVisibleTo(this) ? static_cast<int>(checkedBauds().size()) : 1;
    const double seconds = count * (m_lastId->value() + 1) * SecondsPerId;
    m_summary->setText(count == 0 ? tr("Choose at least one baud rate")
                                  : tr("Takes about %1 s").arg(qMax(1, qRound(seconds))));
    m_scan->setEnabled(count > 0);
}

} // namespace dynascope
