// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/health/healthmodel.h"

#include "ui/common/texts.h"

#include <algorithm>
#include <utility>

namespace dynascope {
namespace {

bool holds(const std::vector<HealthRow> &rows, quint32 key)
{
    return std::ranges::find(rows, key, &HealthRow::key) != rows.end();
}

QString nameOf(const Device &device)
{
    return device.nickname().isEmpty() ? device.model()
                                       : QStringLiteral("%1 · %2").arg(device.nickname(), device.model());
}

} // namespace

void HealthModel::setLine(LineSession *line)
{
    if (m_line == line)
        return;
    if (m_line) {
        m_line->disconnect(this);
        m_line->health().disconnect(this);
    }
    m_line = line;
    if (line) {
        connect(&line->health(), &LineHealth::changed, this, [this] { refresh(); });
        connect(line, &LineSession::deviceAdded, this, [this] { refresh(); });
        connect(line, &LineSession::deviceChanged, this, [this] { refresh(); });
        connect(line, &LineSession::deviceAboutToBeRemoved, this, [this](Device *device) { refresh(device); });
        connect(line, &QObject::destroyed, this, [this] { refresh(); });
    }
    refresh();
}

std::vector<HealthRow> HealthModel::makeRows(const Device *leaving) const
{
    std::vector<HealthRow> rows;
    if (!m_line)
        return rows;
    const LineHealth &health = m_line->health();
    for (const auto &device : m_line->devices()) {
        if (device.get() == leaving || device->baudRate() != m_line->baudRate())
            continue;
        HealthRow row{device->key(), nameOf(*device), {}, health.bytesPerSecond(device->id()), 0};
        if (const DeviceQuality *known = health.quality().device(device->id()))
            row.quality = *known;
        row.quality.id = device->id();
        row.onlyPing = device->answersOnlyPing() || device->raw(Known::StatusReturnLevel) == 0;
        rows.push_back(std::move(row));
    }
    if (rows.empty())
        return rows;
    std::ranges::stable_sort(
        rows, std::ranges::greater(), [](const HealthRow &row) { return badness(row.quality); });
    HealthRow line{0, {}, health.quality().sum(), health.bytesPerSecond(), health.quality().totals.strays};
    line.quality.responses = health.quality().roundTrips;
    rows.push_back(std::move(line));
    return rows;
}

void HealthModel::refresh(const Device *leaving)
{
    const std::vector<HealthRow> wanted = makeRows(leaving);
    removeOthers(wanted);
    insertMissing(wanted);
    order(wanted);
    if (m_rows != wanted) {
        m_rows = wanted;
        emit dataChanged(index(0, 0), index(rowCount() - 1, HealthColumns - 1));
    }
    emit refreshed();
}

void HealthModel::removeOthers(const std::vector<HealthRow> &wanted)
{
    for (int row = rowCount() - 1; row >= 0; --row) {
        if (holds(wanted, m_rows[static_cast<std::size_t>(row)].key))
            continue;
        beginRemoveRows({}, row, row);
        m_rows.erase(m_rows.begin() + row);
        endRemoveRows();
    }
}

void HealthModel::insertMissing(const std::vector<HealthRow> &wanted)
{
    for (const HealthRow &row : wanted) {
        if (holds(m_rows, row.key))
            continue;
        beginInsertRows({}, rowCount(), rowCount());
        m_rows.push_back(row);
        endInsertRows();
    }
}

void HealthModel::order(const std::vector<HealthRow> &wanted)
{
    if (std::ranges::equal(m_rows, wanted, {}, &HealthRow::key, &HealthRow::key))
        return;
    emit layoutAboutToBeChanged({}, VerticalSortHint);
    const std::vector<HealthRow> before = std::exchange(m_rows, wanted);
    const QModelIndexList old = persistentIndexList();
    QModelIndexList moved;
    for (const QModelIndex &one : old) {
        const quint32 key = before[static_cast<std::size_t>(one.row())].key;
        const auto now = std::ranges::find(m_rows, key, &HealthRow::key);
        moved << index(static_cast<int>(now - m_rows.begin()), one.column());
    }
    changePersistentIndexList(old, moved);
    emit layoutChanged({}, VerticalSortHint);
}

const HealthRow *HealthModel::row(int row) const
{
    return row >= 0 && row < rowCount() ? &m_rows[static_cast<std::size_t>(row)] : nullptr;
}

int HealthModel::rowCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : static_cast<int>(m_rows.size());
}

int HealthModel::columnCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : HealthColumns;
}

QVariant HealthModel::data(const QModelIndex &index, int role) const
{
    if (!checkIndex(index, CheckIndexOption::IndexIsValid))
        return {};
    const HealthRow &row = m_rows[static_cast<std::size_t>(index.row())];
    const auto column = static_cast<HealthColumn>(index.column());
    switch (role) {
    case Qt::DisplayRole: return healthCell(row, column);
    case Qt::AccessibleTextRole:
        if (column == HealthColumn::Bad)
            return QStringLiteral("%1, %2").arg(healthCell(row, column), verdictText(verdictOn(row.quality)));
        return healthCell(row, column);
    case Qt::ToolTipRole: return plainToolTip(healthHelp(row, column));
    case Qt::TextAlignmentRole:
        return static_cast<int>((column == HealthColumn::Name ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    case VerdictRole: return static_cast<int>(verdictOn(row.quality));
    case ShareRole: return row.quality.badShare();
    case LineRole: return row.isLine();
    default: return {};
    }
}

QVariant HealthModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation != Qt::Horizontal || section < 0 || section >= HealthColumns)
        return {};
    const auto column = static_cast<HealthColumn>(section);
    switch (role) {
    case Qt::DisplayRole: return healthHeading(column);
    case Qt::ToolTipRole: return healthHelp(column);
    case Qt::TextAlignmentRole:
        return static_cast<int>((column == HealthColumn::Name ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    default: return {};
    }
}

QString HealthModel::toText() const
{
    QStringList lines;
    QStringList cells;
    for (int column = 0; column < HealthColumns; ++column)
        cells << healthHeading(static_cast<HealthColumn>(column));
    lines << cells.join(u'\t');
    for (const HealthRow &row : m_rows) {
        cells.clear();
        for (int column = 0; column < HealthColumns; ++column)
            cells << healthCell(row, static_cast<HealthColumn>(column)).remove(QChar(0x2009)); // for spreadsheets
        lines << cells.join(u'\t');
    }
    return lines.join(u'\n') + u'\n';
}

} // namespace dynascope
