// SPDX-License-Identifier: GPL-3.0-or-later
// What a person has arranged, from one start to the next.
#include "ui/table/helppanel.h"
#include "ui/table/tablepanel.h"
#include "ui/table/tableview.h"

#include <QDataStream>
#include <QIODevice>

namespace dynascope {
namespace {

constexpr quint32 StateVersion = 1;

} // namespace

QByteArray TablePanel::saveState() const
{
    QByteArray state;
    QDataStream out(&state, QIODevice::WriteOnly);
    out.setVersion(QDataStream::Qt_6_4);
    out << StateVersion << QMap<int, int>(m_view->columnWidths()) << QMap<QString, bool>(m_folded)
        << m_help->isFolded();
    return state;
}

void TablePanel::restoreState(const QByteArray &state)
{
    QDataStream in(state);
    in.setVersion(QDataStream::Qt_6_4);
    quint32 version = 0;
    QMap<int, int> widths;
    QMap<QString, bool> folded;
    bool helpFolded = false;
    in >> version >> widths >> folded >> helpFolded;
    if (in.status() != QDataStream::Ok || version != StateVersion)
        return;
    m_view->setColumnWidths(widths.toStdMap());
    m_folded = folded.toStdMap();
    m_help->setFolded(helpFolded);
    updateGroups();
}

} // namespace dynascope
