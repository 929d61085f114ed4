// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/health/ratepopup.h"

#include "core/session/monitor.h"
#include "ui/common/texts.h"
#include "ui/common/theme.h"
#include "ui/health/packingbox.h"
#include "ui/health/ratebar.h"
#include "ui/health/ratetexts.h"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QScreen>
#include <QVBoxLayout>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace dynascope {
namespace {

using What = RateLimit::What;

constexpr int RateRows = 6;  ///< the full rate and intervals
constexpr int FieldRows = 8; ///< watched fields by name
constexpr int BarWidth = 96;
constexpr std::array Shown{What::Baud,       What::ReturnDelay,  What::LatencyTimer,
                           What::PlainReads, What::SilentDevice, What::Devices};
constexpr std::array Rates{0.0, 100.0, 50.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.2};

QLabel *heading(const QString &text, QWidget *parent)
{
    auto *label = new QLabel(text, parent);
    QFont bold = label->font();
    bold.setWeight(QFont::DemiBold);
    label->setFont(bold);
    return label;
}

QGridLayout *gridIn(QVBoxLayout &layout)
{
    auto *grid = new QGridLayout;
    grid->setHorizontalSpacing(16);
    grid->setVerticalSpacing(4);
    grid->setColumnStretch(0, 1);
    layout.addLayout(grid);
    return grid;
}

} // namespace

RatePopup::RatePopup(const Workbench &workbench, LineSession &line, QWidget *parent)
    : QFrame(parent, Qt::Popup)
    , m_workbench(workbench)
    , m_line(&line)
{
    setObjectName(QStringLiteral("ratePopup"));
    setAttribute(Qt::WA_DeleteOnClose);
    setFrameShape(QFrame::StyledPanel);
    setAccessibleName(tr("Polling"));
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(16, 12, 16, 12);
    layout->setSpacing(8);
    addRates(*layout);
    addLimits(*layout);
    addFields(*layout);
    connect(&line, &LineSession::rateChanged, this, &RatePopup::refresh);
    connect(&line, &QObject::destroyed, this, &QWidget::close);
    refresh();
}

QLabel *RatePopup::add(QGridLayout &grid, int row, int column, const QString &text, bool isFigure)
{
    auto *label = new QLabel(text, this);
    label->setTextFormat(Qt::PlainText);
    if (isFigure) {
        label->setFont(numberFont(font()));
        label->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
        label->setMinimumWidth(label->fontMetrics().horizontalAdvance(QStringLiteral("0000.0 Hz")));
    }
    grid.addWidget(label, row, column);
    return label;
}

void RatePopup::addRates(QVBoxLayout &layout)
{
    layout.addWidget(heading(tr("Polling"), this));
    QGridLayout &grid = *gridIn(layout);
    int column = 1;
    for (const QString &text : {tr("Wanted"), tr("Predicted"), tr("Achieved")}) {
        QLabel *label = add(grid, 0, column++, text, false);
        label->setForegroundRole(QPalette::PlaceholderText);
        label->setAlignment(Qt::AlignRight);
    }
    for (int row = 1; row <= RateRows + 1; ++row) { // the last is the bus load's
        m_rates.push_back({add(grid, row, 0, {}, false), add(grid, row, 1, {}, true), add(grid, row, 2, {}, true),
                           add(grid, row, 3, {}, true)});
    }
    m_rates.front().achieved->setObjectName(QStringLiteral("rateAchieved"));
    m_rates.front().predicted->setObjectName(QStringLiteral("ratePredicted"));
}

void RatePopup::addLimits(QVBoxLayout &layout)
{
    layout.addSpacing(4);
    m_verdict = heading({}, this);
    m_verdict->setObjectName(QStringLiteral("rateVerdict"));
    layout.addWidget(m_verdict);
    QGridLayout &grid = *gridIn(layout);
    int row = 0;
    for (const What what : Shown) {
        LimitRow one{add(grid, row, 0, {}, false), add(grid, row, 2, {}, true), add(grid, row, 4, {}, true),
                     new RateBar(BarWidth, this), new QPushButton(this), {}};
        one.limit.what = what;
        one.remedy->setObjectName(QStringLiteral("rateRemedy%1").arg(row));
        grid.addWidget(one.bar, row, 1);
        grid.addWidget(one.remedy, row, 3);
        const std::size_t index = m_limits.size();
        connect(one.remedy, &QPushButton::clicked, this, [this, index] {
            const RateLimit limit = m_limits[index].limit;
            emit remedyChosen(limit);
            if (limit.what == What::ReturnDelay) // it asks
                close();
        });
        m_limits.push_back(one);
        ++row;
    }
    m_fast = new QCheckBox(tr("Fast reads, of devices that know them"), this);
    m_fast->setObjectName(QStringLiteral("fastReadsBox"));
    m_fast->setToolTip(
        tr("One packet with the values of all devices. Off where an adapter or a program on the line can't "
           "take it."));
    m_fast->setChecked(m_workbench.monitor.mayReadFast());
    connect(m_fast, &QCheckBox::toggled, this, [this](bool on) { m_workbench.monitor.setMayReadFast(on); });
    layout.addWidget(m_fast);
    if (m_workbench.indirect)
        layout.addWidget(new PackingBox(*m_workbench.indirect, *m_line, this));
}

/// Watched fields of the line's devices, by name: how often each is wanted.
void RatePopup::addFields(QVBoxLayout &layout)
{
    std::map<QString, std::vector<Watch>> byName;
    for (const Watch &watch : m_workbench.monitor.watches()) {
        const Device *device = m_line->device(watch.device);
        if (device)
            byName[device->table().fields()[static_cast<std::size_t>(watch.field)].name].push_back(watch);
    }
    if (byName.empty())
        return;
    layout.addSpacing(4);
    layout.addWidget(heading(tr("Plotted, how often"), this));
    QGridLayout &grid = *gridIn(layout);
    int row = 0;
    for (const auto &[name, watches] : byName) {
        if (row == FieldRows) {
            add(grid, row, 0, tr("and %1 more").arg(byName.size() - FieldRows), false)
                ->setForegroundRole(QPalette::PlaceholderText);
            break;
        }
        add(grid, row, 0, watches.size() > 1 ? tr("%1, %2 devices").arg(name).arg(watches.size()) : name, false);
        auto *list = new QComboBox(this);
        list->setAccessibleName(name);
        list->setObjectName(QStringLiteral("wantedRate%1").arg(row));
        const double now = m_workbench.monitor.rate(watches.front());
        for (const double hertz : Rates)
            list->addItem(hertz > 0 ? intervalText(std::chrono::milliseconds(qRound(1000 / hertz))) : intervalText({}),
                          hertz);
        list->setCurrentIndex(std::max(0, list->findData(now)));
        connect(list, &QComboBox::activated, this, [this, list, watches = watches] {
            for (const Watch &watch : watches)
                m_workbench.monitor.setRate(watch, list->currentData().toDouble());
        });
        grid.addWidget(list, row++, 1);
    }
}

void RatePopup::open(const QWidget &over)
{
    adjustSize();
    const QRect room = over.screen()->availableGeometry();
    const QPoint corner = over.mapToGlobal(QPoint(over.width() - width(), -height() - 4));
    move(std::clamp(corner.x(), room.left(), std::max(room.left(), room.right() - width())),
         std::max(room.top(), corner.y()));
    show();
}

void RatePopup::refresh()
{
    if (!m_line)
        return;
    refreshRates();
    refreshLimits();
}

void RatePopup::refreshRates()
{
    const PollPrediction &predicted = m_line->prediction();
    std::map<std::chrono::milliseconds, int> spans;
    for (const PollSpan &span : m_line->pollPlan().spans)
        ++spans[span.interval];
    double fastest = 0; // of what is wanted at intervals
    for (const auto &[interval, count] : spans)
        fastest = std::max(fastest, interval.count() > 0 ? 1000.0 / static_cast<double>(interval.count()) : 0.0);
    std::size_t row = 0;
    const auto show = [&](const QString &name, const QString &wanted, const QString &then, const QString &now) {
        Row &labels = m_rates[row++];
        labels.name->setText(name);
        labels.wanted->setText(wanted);
        labels.predicted->setText(then);
        labels.achieved->setText(now);
    };
    const QString none = QStringLiteral("–");
    for (const auto &[interval, count] : spans) {
        if (row == RateRows)
            break;
        if (interval.count() == 0) {
            const double rate = m_line->cycleRate();
            show(tr("Every cycle"), tr("all"), predicted.cycleRate > 0 ? hertzText(predicted.cycleRate) : none,
                 rate > 0 ? hertzText(rate) : none);
            continue;
        }
        const double wanted = 1000.0 / static_cast<double>(interval.count());
        const bool isRare = wanted < 0.5; // between two reports mostly none comes
        const double achieved = m_line->health().answersPerSecond(interval) / count;
        show(interval.count() > 1000 ? tr("Signs of a restart") : tr("At intervals"), intervalText(interval),
             isRare ? none : hertzText(std::min(wanted, predicted.met * fastest)), isRare ? none : hertzText(achieved));
    }
    show(tr("Bus load"), {}, tr("%1 %").arg(qRound(predicted.busLoad * 100)),
         tr("%1 %").arg(qRound(m_line->busLoad() * 100)));
    for (; row < m_rates.size();)
        show({}, {}, {}, {});
    for (const Row &labels : m_rates) {
        for (QLabel *label : {labels.name, labels.wanted, labels.predicted, labels.achieved})
            label->setVisible(!labels.name->text().isEmpty());
    }
}

void RatePopup::refreshLimits()
{
    const std::vector<RateLimit> limits = m_line->limits();
    if (limits.empty())
        m_verdict->setText(tr("What takes the time…"));
    else if (limits.front().what == What::Nothing)
        m_verdict->setText(tr("Nothing holds it up: what is wanted comes"));
    else
        m_verdict->setText(tr("What takes the time: %1").arg(limitName(limits.front(), m_line->baudRate())));
    for (LimitRow &row : m_limits) {
        const auto at = std::ranges::find(limits, row.limit.what, &RateLimit::what);
        const bool isThere = at != limits.end();
        if (isThere) {
            row.limit = *at;
            row.name->setText(limitName(*at, m_line->baudRate()));
            row.name->setToolTip(plainToolTip(limitHelp(*at, m_line->baudRate())));
            row.share->setText(tr("%1 %").arg(qRound(at->share * 100)));
            static_cast<RateBar *>(row.bar)->setShare(at->share, at == limits.begin());
            row.gain->setText(gainText(*at, m_line->prediction().cycleRate));
            row.remedy->setText(remedyText(*at));
            row.remedy->setToolTip(plainToolTip(limitHelp(*at, m_line->baudRate())));
        }
        for (QWidget *widget : {static_cast<QWidget *>(row.name), static_cast<QWidget *>(row.share),
                                static_cast<QWidget *>(row.gain), row.bar})
            widget->setVisible(isThere);
        row.remedy->setVisible(isThere && at->hasRemedy);
    }
    m_fast->setChecked(m_workbench.monitor.mayReadFast());
    adjustSize();
}

} // namespace dynascope
