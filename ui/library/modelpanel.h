// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/catalog.h"
#include "core/table/usertables.h"

#include <QWidget>

class QLabel;
class QLineEdit;
class QModelIndex;
class QSortFilterProxyModel;
class QStackedWidget;
class QStandardItem;
class QStandardItemModel;
class QTreeView;

namespace dynascope {

/// Every model there is, by series, and the files that were refused; filtered by name, number or another name.
class ModelPanel : public QWidget
{
    Q_OBJECT

public:
    ModelPanel(const Catalog &catalog, const std::vector<RefusedTable> &refused, QWidget *parent = nullptr);

    void select(int modelNumber); ///< takes the filter away where it hides the model
    int current() const;          ///< its number; −1: none is

signals:
    void modelChosen(int modelNumber);
    void refusedChosen(const QString &file, const QString &message);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void fill(const Catalog &catalog);
    void add(const Catalog::ModelInfo &info);
    void fillRefused(const std::vector<RefusedTable> &refused);
    QStandardItem *group(const QString &title);
    void makeView();
    void filter(const QString &text);
    void choose(const QModelIndex &index);
    QModelIndex firstModel(const QModelIndex &below) const;

    QStandardItemModel *m_model;
    QSortFilterProxyModel *m_shown;
    QLineEdit *m_filter;
    QTreeView *m_view;
    QLabel *m_empty;
    QStackedWidget *m_stack;
};

} // namespace dynascope
