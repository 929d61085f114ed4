// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/backup/comparemodel.h"

#include "ui/common/icons.h"
#include "ui/common/texts.h"

namespace dynascope {
namespace {

using State = ComparedRegister::State;

QString useText(BackupUse use)
{
    switch (use) {
    case BackupUse::Calibration: return CompareModel::tr("of the single device");
    case BackupUse::Place: return CompareModel::tr("where it is");
    case BackupUse::Motion:
    case BackupUse::Order: return CompareModel::tr("never restored");
    case BackupUse::Reading: return CompareModel::tr("a reading");
    case BackupUse::Identity: return CompareModel::tr("can't change");
    case BackupUse::Setting: break;
    }
    return {};
}

QString statusText(const ComparedRegister &row)
{
    QString text;
    switch (row.state) {
    case State::Same: text = CompareModel::tr("same"); break;
    case State::Differs: text = CompareModel::tr("differs"); break;
    case State::OnlyHere: text = CompareModel::tr("only here"); break;
    case State::OnlyThere: text = CompareModel::tr("only there"); break;
    case State::OtherMeaning: text = CompareModel::tr("not comparable"); break;
    }
    const QString use = useText(row.use);
    return use.isEmpty() ? text : CompareModel::tr("%1 (%2)").arg(text, use);
}

QIcon statusIcon(const ComparedRegister &row)
{
    if (row.isReading() || row.isSame())
        return row.isSame() ? icon(QStringLiteral("check"), IconTint::Good) : QIcon();
    return row.state == State::Differs ? icon(QStringLiteral("warning"), IconTint::Warning)
                                       : icon(QStringLiteral("info"), IconTint::Accent);
}

} // namespace

void CompareModel::setRows(std::vector<ComparedRegister> rows)
{
    m_rows = std::move(rows);
    choose();
}

void CompareModel::setShow(Show show)
{
    m_show = show;
    choose();
}

void CompareModel::setFilter(const QString &text)
{
    m_filter = normalizedName(text);
    choose();
}

void CompareModel::setTitles(const QString &here, const QString &there)
{
    m_here = here;
    m_there = there;
    emit headerDataChanged(Qt::Horizontal, 0, CompareColumns - 1);
}

void CompareModel::choose()
{
    beginResetModel();
    m_shown.clear();
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        const ComparedRegister &row = m_rows[i];
        const bool isHidden = m_show == Show::Differences && (row.isSame() || row.isReading());
        if (!isHidden && normalizedName(row.name).contains(m_filter))
            m_shown.push_back(i);
    }
    endResetModel();
}

int CompareModel::rowCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : static_cast<int>(m_shown.size());
}

int CompareModel::columnCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : CompareColumns;
}

QVariant CompareModel::data(const QModelIndex &index, int role) const
{
    const ComparedRegister &row = at(index.row());
    const auto column = static_cast<CompareColumn>(index.column());
    if (role == Qt::DecorationRole && column == CompareColumn::Status)
        return statusIcon(row);
    if (role == Qt::ToolTipRole)
        return row.why.isEmpty() ? QVariant() : QVariant(withBaudTexts(row.why).toHtmlEscaped());
    if (role != Qt::DisplayRole)
        return {};
    switch (column) {
    case CompareColumn::Name: return row.name;
    case CompareColumn::Here: return row.here ? withBaudTexts(row.hereText) : QStringLiteral("–");
    case CompareColumn::There: return row.there ? withBaudTexts(row.thereText) : QStringLiteral("–");
    case CompareColumn::Status: return statusText(row);
    }
    return {};
}

QVariant CompareModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole)
        return {};
    switch (static_cast<CompareColumn>(section)) {
    case CompareColumn::Name: return tr("Register");
    case CompareColumn::Here: return m_here;
    case CompareColumn::There: return m_there;
    case CompareColumn::Status: return tr("Status");
    }
    return {};
}

} // namespace dynascope
