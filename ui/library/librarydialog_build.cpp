// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of the dialog, put together once.
#include "ui/library/librarydialog.h"

#include "ui/common/icons.h"
#include "ui/library/libraryview.h"
#include "ui/library/modelheader.h"
#include "ui/library/registermodel.h"
#include "ui/library/searchmodel.h"
#include "ui/table/fieldfiltermodel.h"

#include <QAction>
#include <QButtonGroup>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QSplitter>
#include <QStackedWidget>
#include <QTextBrowser>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <array>

namespace dynascope {
namespace {

constexpr int DetailsHeight = 190;
constexpr std::array RegisterWidths{66, 140, 42, 78, 62, 62, 120, 84, 72};
constexpr std::array ResultWidths{200, 110, 46, 120, 120};

/// These take what is left of the width.
void stretch(const QTreeView &view, std::initializer_list<int> columns)
{
    view.header()->setStretchLastSection(false);
    for (const int column : columns)
        view.header()->setSectionResizeMode(column, QHeaderView::Stretch);
}

} // namespace

QWidget *LibraryDialog::makeRight(const QString &folder)
{
    m_header = new ModelHeader(folder, this);
    makeRegisterView();
    makeResultView();
    m_nothing->setObjectName(QStringLiteral("libraryNothing"));
    m_nothing->setAlignment(Qt::AlignCenter);
    m_nothing->setWordWrap(true);
    m_nothing->setTextFormat(Qt::PlainText);
    m_nothing->setContentsMargins(24, 24, 24, 24);
    m_nothing->setBackgroundRole(QPalette::Base);
    m_nothing->setAutoFillBackground(true);
    m_nothing->setForegroundRole(QPalette::PlaceholderText);
    m_stack = new QStackedWidget(this);
    m_stack->addWidget(m_registerView);
    m_stack->addWidget(m_resultView);
    m_stack->addWidget(m_nothing);
    m_page->setObjectName(QStringLiteral("libraryPage"));
    m_page->setAccessibleName(tr("What the register is for"));
    m_page->setFrameShape(QFrame::NoFrame);
    m_page->setOpenLinks(false);
    m_page->document()->setDocumentMargin(12);
    m_rows = new QSplitter(Qt::Vertical, this);
    m_rows->addWidget(m_stack);
    m_rows->addWidget(m_page);
    m_rows->setStretchFactor(0, 1);
    m_rows->setChildrenCollapsible(false);
    m_rows->setSizes({10 * DetailsHeight, DetailsHeight});
    auto *right = new QWidget(this);
    auto *layout = new QVBoxLayout(right);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_header);
    layout->addWidget(makeTools());
    layout->addWidget(m_rows, 1);
    return right;
}

QToolButton *LibraryDialog::makeScope(const char *name, const QString &text, const QString &toolTip)
{
    auto *button = new QToolButton(this);
    button->setObjectName(QLatin1String(name));
    button->setText(text);
    button->setToolTip(toolTip);
    button->setCheckable(true);
    return button;
}

QWidget *LibraryDialog::makeTools()
{
    auto *tools = new QWidget(this);
    m_search = new QLineEdit(tools);
    m_search->setObjectName(QStringLiteral("librarySearch"));
    m_search->setAccessibleName(tr("Search the registers"));
    m_search->setClearButtonEnabled(true);
    m_search->addAction(icon(QStringLiteral("search"), IconTint::Dimmed), QLineEdit::LeadingPosition);
    m_search->installEventFilter(this);
    connect(m_search, &QLineEdit::textChanged, this, &LibraryDialog::refreshList);
    m_thisModel = makeScope("libraryThisModel", tr("This model"), tr("Search the registers of this model (Alt+1)"));
    m_allModels = makeScope("libraryAllModels", tr("All models"), tr("Search the registers of all models (Alt+2)"));
    auto *scopes = new QButtonGroup(this);
    scopes->addButton(m_thisModel);
    scopes->addButton(m_allModels);
    m_thisModel->setChecked(true);
    connect(m_allModels, &QToolButton::toggled, this, &LibraryDialog::setAllModels);
    m_copy = new QToolButton(tools);
    m_copy->setObjectName(QStringLiteral("libraryCopy"));
    m_copy->setIcon(icon(QStringLiteral("copy")));
    m_copy->setAutoRaise(true);
    m_copy->setToolTip(tr("Copy the selected rows as text, or all (Ctrl+C)"));
    m_copy->setAccessibleName(tr("Copy rows as text"));
    connect(m_copy, &QToolButton::clicked, this, [this] { listShown()->copy(); });
    auto *layout = new QHBoxLayout(tools);
    layout->setContentsMargins(8, 4, 8, 8);
    layout->setSpacing(6);
    layout->addWidget(m_search, 1);
    for (QToolButton *button : {m_thisModel, m_allModels, m_copy})
        layout->addWidget(button);
    return tools;
}

void LibraryDialog::makeRegisterView()
{
    m_registerView->setTreePosition(RegisterModel::Name);
    m_registerView->setIndentation(14);
    m_filtered->setSourceModel(m_registers);
    m_registerView->setModel(m_filtered);
    for (int column = 0; column < RegisterModel::ColumnCount; ++column)
        m_registerView->setColumnWidth(column, RegisterWidths[static_cast<std::size_t>(column)]);
    stretch(*m_registerView, {RegisterModel::Name});
    connect(m_registerView->selectionModel(), &QItemSelectionModel::currentChanged, this, &LibraryDialog::refreshPage);
}

void LibraryDialog::makeResultView()
{
    m_resultView->setModel(m_results);
    for (int column = 0; column < SearchModel::ColumnCount; ++column)
        m_resultView->setColumnWidth(column, ResultWidths[static_cast<std::size_t>(column)]);
    stretch(*m_resultView, {SearchModel::Name, SearchModel::Series, SearchModel::Models});
    connect(m_resultView->selectionModel(), &QItemSelectionModel::currentChanged, this, &LibraryDialog::refreshPage);
    connect(m_resultView, &QTreeView::activated, this, &LibraryDialog::openResult);
}

void LibraryDialog::addKeys()
{
    const auto add = [this](const QString &keys, auto what) {
        auto *action = new QAction(this);
        action->setShortcut(QKeySequence(keys));
        action->setAutoRepeat(false);
        connect(action, &QAction::triggered, this, what);
        addAction(action);
    };
    add(QStringLiteral("Ctrl+F"), [this] {
        m_search->setFocus(Qt::ShortcutFocusReason);
        m_search->selectAll();
    });
    add(QStringLiteral("Alt+1"), [this] { m_thisModel->setChecked(true); });
    add(QStringLiteral("Alt+2"), [this] { m_allModels->setChecked(true); });
}

/// Limits and units have more room in a wide window.
void LibraryDialog::resizeEvent(QResizeEvent *event)
{
    m_registerView->setColumnWidth(RegisterModel::Range, std::clamp(width() * 3 / 5 - 446, 120, 300));
    m_registerView->setColumnWidth(RegisterModel::UnitColumn, std::clamp(width() / 9, 84, 124));
    QDialog::resizeEvent(event);
}

} // namespace dynascope
