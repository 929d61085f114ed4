// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/catalog.h"
#include "core/table/units.h"
#include "core/table/usertables.h"

#include <QDialog>

class QLabel;
class QLineEdit;
class QModelIndex;
class QSplitter;
class QStackedWidget;
class QTextBrowser;
class QToolButton;

namespace dynascope {

class FieldFilterModel;
class LibraryReader;
class LibraryView;
class ModelHeader;
class ModelPanel;
class RegisterModel;
class SearchModel;

/// The library of control tables, to look things up without any device: the models left, the registers of one right, or
/// those of all models that a search finds; what is known of a register below. Shown by present().
class LibraryDialog : public QDialog
{
    Q_OBJECT

public:
    /// The catalog outlives the dialog.
    LibraryDialog(const Catalog &catalog, const std::vector<RefusedTable> &refused, QWidget *parent = nullptr);
    ~LibraryDialog() override;

    void setUnits(const UnitPreferences &units);
    void showModel(int modelNumber, int firmware); ///< firmware −1: the newest
    void showRegister(const QString &name);        ///< of the model that is shown
    void search(const QString &text);              ///< over all models

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;
    void changeEvent(QEvent *event) override;
    void resizeEvent(QResizeEvent *event) override;
    void done(int result) override;

private:
    enum Page { Registers, Results, Nothing };

    QWidget *makeRight(const QString &folder);
    QWidget *makeTools();
    void makeRegisterView();
    void makeResultView();
    QToolButton *makeScope(const char *name, const QString &text, const QString &toolTip);
    void addKeys();
    void setAllModels(bool all);
    void showTable(std::size_t table);
    void showRefused(const QString &file, const QString &message);
    void refreshList();
    void refreshPage();
    void openResult(const QModelIndex &index);
    bool isRefusedShown() const { return !m_refusedFile.file.isEmpty(); }
    LibraryView *listShown() const;

    const Catalog &m_catalog;
    LibraryReader *m_reader;
    ModelPanel *m_models;
    ModelHeader *m_header = nullptr;
    RegisterModel *m_registers;
    FieldFilterModel *m_filtered;
    SearchModel *m_results;
    QSplitter *m_columns;
    QSplitter *m_rows = nullptr;
    QLineEdit *m_search = nullptr;
    QToolButton *m_thisModel = nullptr;
    QToolButton *m_allModels = nullptr;
    QToolButton *m_copy = nullptr;
    QStackedWidget *m_stack = nullptr;
    LibraryView *m_registerView;
    LibraryView *m_resultView;
    QLabel *m_nothing;
    QTextBrowser *m_page;
    std::vector<ControlTablePtr> m_tables; ///< of the model that is shown
    RefusedTable m_refusedFile;            ///< is shown instead of a model; without a name: none is
    UnitPreferences m_units;
    QString m_otherSearch;                 ///< the text of the scope that isn't shown
};

} // namespace dynascope
