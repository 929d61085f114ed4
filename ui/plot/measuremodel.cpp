// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/measuremodel.h"

#include "ui/common/texts.h"
#include "ui/plot/plotreadout.h"

#include <algorithm>
#include <cmath>

namespace dynascope {

namespace {

QString numberText(double value, int decimals)
{
    return withMinus(QString::number(value, 'f', decimals));
}

} // namespace

MeasureModel::MeasureModel(QObject *parent) : QAbstractTableModel(parent) { }

void MeasureModel::describe(Row &row, const TraceData &trace, const PlotCursors &cursors, LineTime zero) const
{
    row.label = trace.shortLabel();
    row.unit = trace.unit;
    row.color = trace.color;
    row.scale = trace.scale;
    row.offset = trace.offset;
    row.decimals = trace.decimals;
    for (std::size_t i = 0; i < 2; ++i) {
        History::Sample sample;
        row.ends[i].reset();
        if (trace.isDrawn() && PlotReadout::sampleAt(*trace.history, zero + cursors.at[i], sample))
            row.ends[i] = trace.value(sample.raw);
    }
}

bool MeasureModel::measure(
    const std::vector<TraceData> &traces, const PlotCursors &cursors, LineTime zero, std::size_t &budget)
{
    const auto shown = static_cast<std::size_t>(std::ranges::count_if(traces, &TraceData::visible));
    if (shown != m_rows.size()) {
        beginResetModel();
        m_rows.resize(shown);
        endResetModel();
    }
    m_distance = cursors.distanceText();
    std::vector<const TraceData *> visible;
    for (const TraceData &trace : traces) {
        if (trace.visible)
            visible.push_back(&trace);
    }
    bool isDone = true;
    for (std::size_t i = 0; i < shown; ++i)
        describe(m_rows[i], *visible[i], cursors, zero);
    for (std::size_t i = 0; i < shown; ++i) {
        const std::size_t at = (m_next + i) % shown;
        if (!visible[at]->isDrawn()) {
            m_rows[at].measure = {};
            continue;
        }
        // The sample at the later cursor counts, too.
        m_rows[at].measure.advance(
            *visible[at]->history, zero + cursors.earlier(), zero + cursors.later() + LineTime(1), budget);
        isDone = isDone && m_rows[at].measure.isDone();
    }
    m_next = shown > 0 ? (m_next + 1) % shown : 0;
    return isDone;
}

std::array<QString, MeasureModel::ColumnCount> MeasureModel::textsOf(const Row &row)
{
    std::array<QString, ColumnCount> texts;
    texts.fill(QStringLiteral("–"));
    texts[Name] = withUnit(row.label, row.unit);
    for (std::size_t i = 0; i < 2; ++i) {
        if (row.ends[i])
            texts[AtA + i] = numberText(*row.ends[i], row.decimals);
    }
    if (row.ends[0] && row.ends[1])
        texts[Change] = numberText(*row.ends[1] - *row.ends[0], row.decimals);
    const Measured &result = row.measure.result();
    if (result.samples == 0)
        return texts;
    const double one = result.minimum * row.scale + row.offset;
    const double other = result.maximum * row.scale + row.offset;
    const int finer = row.decimals + 1; // an average knows more than a sample
    texts[Mean] = numberText(result.mean * row.scale + row.offset, finer);
    texts[Minimum] = numberText(std::min(one, other), row.decimals);
    texts[Maximum] = numberText(std::max(one, other), row.decimals);
    texts[Rms] = numberText(result.rms(row.scale, row.offset), finer);
    if (result.hertz)
        texts[Frequency] = numberText(*result.hertz, *result.hertz >= 100 ? 1 : *result.hertz >= 10 ? 2 : 3);
    return texts;
}

void MeasureModel::show()
{
    if (m_distance != m_shownDistance) {
        m_shownDistance = m_distance;
        emit headerDataChanged(Qt::Horizontal, Name, Name);
    }
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        std::array<QString, ColumnCount> texts = textsOf(m_rows[i]);
        if (texts == m_rows[i].texts && m_rows[i].shownColor == m_rows[i].color)
            continue;
        m_rows[i].shownColor = m_rows[i].color;
        m_rows[i].texts = std::move(texts);
        const int row = static_cast<int>(i);
        emit dataChanged(index(row, 0), index(row, ColumnCount - 1));
    }
}

int MeasureModel::rowCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : static_cast<int>(m_rows.size());
}

int MeasureModel::columnCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : ColumnCount;
}

QVariant MeasureModel::data(const QModelIndex &index, int role) const
{
    if (!index.isValid())
        return {};
    const Row &row = m_rows[static_cast<std::size_t>(index.row())];
    switch (role) {
    case Qt::DisplayRole: return row.texts[static_cast<std::size_t>(index.column())];
    case Qt::ToolTipRole: return index.column() == Name ? plainToolTip(row.texts[Name]) : QVariant();
    case Qt::DecorationRole: return index.column() == Name ? QVariant(row.color) : QVariant();
    case Qt::TextAlignmentRole:
        return QVariant::fromValue((index.column() == Name ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    default: return {};
    }
}

QVariant MeasureModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation != Qt::Horizontal)
        return {};
    if (role == Qt::TextAlignmentRole)
        return QVariant::fromValue((section == Name ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    if (role == Qt::DisplayRole) {
        const QString texts[]{m_shownDistance, tr("A"), tr("B"), tr("Δy"), tr("Mean"), tr("Min"), tr("Max"), tr("RMS"),
            tr("Hz")};
        return texts[section];
    }
    if (role != Qt::ToolTipRole)
        return {};
    const QString tips[]{tr("Time from A to B, and the frequency of which it is one period"), tr("Value at cursor A"),
        tr("Value at cursor B"), tr("Value at B less value at A"), tr("Mean of the samples between the cursors"),
        tr("Smallest sample between the cursors"), tr("Largest sample between the cursors"),
        tr("Root of the mean square of the samples between the cursors; it counts from zero, not from the mean"),
        tr("Whole periods by the time they took: from rising crossing to rising crossing of the mean, where the signal "
           "goes an eighth of its peak-to-peak beyond it on both sides")};
    return tips[section];
}

} // namespace dynascope
