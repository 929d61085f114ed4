// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/ui/tablefixture.h"
#include "ui/table/tablepanel.h"
#include "ui/table/tableview.h"
#include "ui/table/valueedit.h"

namespace dynascope {

/// A panel on screen with what a test reaches for.
struct TableWindow {
    explicit TableWindow(TableFixture &fixture) : TableWindow(fixture.actions()) { }
    explicit TableWindow(const TableActions &actions)
        : panel(actions)
        , view(panel.findChild<TableView *>(QStringLiteral("tableView")))
    {
        panel.resize(900, 900);
        panel.show();
    }

    QModelIndex cell(const QString &name, ColumnKind kind) const
    {
        const QAbstractItemModel *model = view->model();
        for (int group = 0; group < model->rowCount(); ++group) {
            const QModelIndex parent = model->index(group, 0);
            for (int row = 0; row < model->rowCount(parent); ++row) {
                const QModelIndex first = model->index(row, 0, parent);
                if (first.data().toString() != name)
                    continue;
                for (int column = 0; column < model->columnCount(); ++column) {
                    if (kindAt(first.siblingAtColumn(column)) == kind)
                        return first.siblingAtColumn(column);
                }
            }
        }
        return {};
    }

    void go(const QString &name, ColumnKind kind = ColumnKind::Value)
    {
        view->scrollTo(cell(name, kind));
        view->setCurrentIndex(cell(name, kind));
    }

    ValueEdit *edit() const { return view->findChild<ValueEdit *>(); }
    template <typename Widget>
    Widget *find(const char *name) const
    {
        return panel.findChild<Widget *>(QString::fromLatin1(name));
    }

    TablePanel panel;
    TableView *view;
};

} // namespace dynascope
