// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/librarydialog.h"

#include "ui/library/librarytexts.h"
#include "ui/library/libraryreader.h"
#include "ui/library/libraryview.h"
#include "ui/library/modelheader.h"
#include "ui/library/modelpanel.h"
#include "ui/library/registermodel.h"
#include "ui/library/searchmodel.h"
#include "ui/table/fieldfiltermodel.h"
#include "ui/table/tableroles.h"

#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QSettings>
#include <QSplitter>
#include <QStackedWidget>
#include <QTextBrowser>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

namespace dynascope {
namespace {

const QString GeometryKey = QStringLiteral("library/geometry");
const QString ModelKey = QStringLiteral("library/model");
constexpr int FirstModel = 1020; ///< XM430-W350, where nobody has chosen one yet
constexpr int ModelsWidth = 230;

/// Of all kinds of firmware, the oldest first.
std::vector<ControlTablePtr> tablesOf(const Catalog &catalog, int modelNumber)
{
    std::vector<ControlTablePtr> tables;
    for (const int firmware : catalog.firmwareSteps(modelNumber)) {
        if (ControlTablePtr table = catalog.find(modelNumber, firmware))
            tables.push_back(std::move(table));
    }
    return tables;
}

} // namespace

LibraryDialog::LibraryDialog(const Catalog &catalog, const std::vector<RefusedTable> &refused, QWidget *parent)
    : QDialog(parent)
    , m_catalog(catalog)
    , m_reader(new LibraryReader(catalog, this))
    , m_models(new ModelPanel(catalog, refused, this))
    , m_registers(new RegisterModel(this))
    , m_filtered(new FieldFilterModel(this))
    , m_results(new SearchModel(catalog, this))
    , m_columns(new QSplitter(Qt::Horizontal, this))
    , m_registerView(new LibraryView(QStringLiteral("libraryRegisters"), tr("Registers"), this))
    , m_resultView(new LibraryView(QStringLiteral("libraryResults"), tr("Registers of all models"), this))
    , m_nothing(new QLabel(this))
    , m_page(new QTextBrowser(this))
{
    setObjectName(QStringLiteral("libraryDialog"));
    setWindowTitle(tr("Control tables"));
    setWindowFlag(Qt::WindowMaximizeButtonHint);
    m_models->setMinimumWidth(160);
    m_columns->addWidget(m_models);
    m_columns->addWidget(makeRight(userTablesFolder()));
    m_columns->setStretchFactor(1, 1);
    m_columns->setChildrenCollapsible(false);
    m_columns->setSizes({ModelsWidth, 10 * ModelsWidth});
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(m_columns);
    setMinimumSize(760, 480);
    resize(1120, 760);
    restoreGeometry(QSettings().value(GeometryKey).toByteArray());
    addKeys();
    connect(m_models, &ModelPanel::modelChosen, this, [this](int number) {
        const ControlTablePtr &shown = m_registers->table();
        if (m_allModels->isChecked() || !shown || shown->modelNumber() != number)
            showModel(number, -1);
    });
    connect(m_header, &ModelHeader::tableChosen, this,
            [this](int table) { showTable(static_cast<std::size_t>(table)); });
    connect(m_models, &ModelPanel::refusedChosen, this, &LibraryDialog::showRefused);
    connect(m_reader, &LibraryReader::progressed, this, [this] {
        if (m_allModels->isChecked())
            refreshList();
    });
    m_models->select(m_catalog.model(QSettings().value(ModelKey).toInt()) ? QSettings().value(ModelKey).toInt()
                                                                          : FirstModel);
    m_search->setFocus();
}

LibraryDialog::~LibraryDialog() = default;

void LibraryDialog::showModel(int modelNumber, int firmware)
{
    if (m_models->current() != modelNumber) {
        m_models->select(modelNumber); // comes back here
        if (firmware < 0)
            return;
    }
    const Catalog::ModelInfo *info = m_catalog.model(modelNumber);
    if (!info)
        return;
    m_refusedFile = {};
    m_tables = tablesOf(m_catalog, modelNumber);
    m_thisModel->setChecked(true);
    const auto shown = std::ranges::find(m_tables, m_catalog.find(modelNumber, firmware < 0 ? 255 : firmware));
    showTable(shown == m_tables.end() ? 0 : static_cast<std::size_t>(shown - m_tables.begin()));
}

void LibraryDialog::showTable(std::size_t table)
{
    if (table >= m_tables.size())
        return;
    const Field *before = fieldAt(m_registerView->currentIndex());
    const QString name = before ? before->name : QString();
    const Catalog::ModelInfo *info = m_catalog.model(int(m_tables[table]->modelNumber()));
    m_registers->setTable(m_tables[table], m_tables);
    m_registerView->setColumnHidden(RegisterModel::Firmware, !m_registers->hasSeveralFirmware());
    if (info)
        m_header->setModel(*info, m_tables, table);
    refreshList();
    // The same register in the next model: that is what one compares.
    const int field = std::max(0, m_registers->table()->indexOf(name));
    const QModelIndex same = m_filtered->mapFromSource(m_registers->indexOf(field, RegisterModel::Name));
    m_registerView->setCurrentIndex(same.isValid() ? same : m_filtered->index(0, RegisterModel::Name));
    m_registerView->scrollTo(m_registerView->currentIndex());
}

void LibraryDialog::showRefused(const QString &file, const QString &message)
{
    m_thisModel->setChecked(true);
    m_refusedFile.file = file;
    m_refusedFile.text = message;
    m_registers->setTable(nullptr, {});
    m_header->setRefused(file, message);
    refreshList();
}

void LibraryDialog::search(const QString &text)
{
    m_allModels->setChecked(true);
    m_search->setText(text);
}

void LibraryDialog::setAllModels(bool all)
{
    QString before = std::exchange(m_otherSearch, m_search->text());
    if (all && before.isEmpty())
        before = m_otherSearch; // the same question, asked of all
    if (all) {
        m_reader->start();
        m_header->setTitle(tr("All models"), {});
    } else if (isRefusedShown()) {
        m_header->setRefused(m_refusedFile.file, m_refusedFile.text);
    } else if (m_registers->table()) {
        const auto shown = std::ranges::find(m_tables, m_registers->table());
        if (const Catalog::ModelInfo *info = m_catalog.model(int(m_registers->table()->modelNumber())))
            m_header->setModel(*info, m_tables, static_cast<std::size_t>(shown - m_tables.begin()));
    }
    if (m_search->text() == before)
        refreshList();
    else
        m_search->setText(before);
}

LibraryView *LibraryDialog::listShown() const
{
    return m_allModels->isChecked() ? m_resultView : m_registerView;
}

void LibraryDialog::refreshList()
{
    const bool all = m_allModels->isChecked();
    const QString text = m_search->text().trimmed();
    m_search->setPlaceholderText(all ? tr("Register or address in all models: Goal Current, 102, 0x66")
                                     : tr("Search name, address, help"));
    Page page = Registers;
    if (all) {
        m_results->setMatches(m_reader->index().find(text));
        if (m_results->rowCount() == 1)
            m_resultView->expand(m_results->index(0, 0));
        page = m_results->rowCount() > 0 ? Results : Nothing;
        m_resultView->setCurrentIndex(m_results->index(0, 0));
        m_nothing->setText(text.isEmpty()
                               ? tr("Type a register's name, or an address, to see which models have it.")
                               : tr("No register of any model is called “%1” or lies at that address.").arg(text));
        m_header->setTitle(
            tr("All models"),
            m_reader->isDone()
                ? tr("%1 models").arg(m_reader->total())
                : tr("Reading the tables: %1 of %2 models").arg(m_reader->done()).arg(m_reader->total()));
    } else {
        m_filtered->setSearch(text);
        if (m_filtered->isFiltering())
            m_registerView->expandAll(); // what was found is seen
        else
            m_registerView->collapseAll();
        if (m_registerView->currentIndex().isValid())
            m_registerView->scrollTo(m_registerView->currentIndex()); // opens what it is in
        page = m_filtered->rowCount() > 0 ? Registers : Nothing;
        m_nothing->setText(isRefusedShown()
                               ? QString()
                               : tr("No register of this model has “%1” in its name, address or help.").arg(text));
    }
    m_stack->setCurrentIndex(page);
    m_copy->setEnabled(page != Nothing);
    refreshPage();
}

void LibraryDialog::setUnits(const UnitPreferences &units)
{
    m_units = units;
    refreshPage();
}

/// What is known of the current row's register.
void LibraryDialog::refreshPage()
{
    ControlTablePtr table = m_registers->table();
    std::vector<ControlTablePtr> all = m_tables;
    const Field *field = nullptr;
    if (m_stack->currentIndex() == Registers) {
        const QModelIndex row = m_registerView->currentIndex().siblingAtColumn(0);
        field = fieldAt(row.data(GroupRole).isValid() ? m_filtered->index(0, 0, row) : row); // of a run the first
    } else if (const RegisterIndex::Entry *found = m_results->entry(m_resultView->currentIndex());
               found && m_stack->currentIndex() == Results) {
        const RegisterIndex::Owner owner = m_results->owner(m_resultView->currentIndex());
        table = m_catalog.find(owner.modelNumber, owner.firmwareTo);
        all = tablesOf(m_catalog, owner.modelNumber);
        field = table ? table->find(found->name) : nullptr;
    }
    QString html = field ? registerPage(*field, *table, all, m_units, palette()) : QString();
    if (field && m_stack->currentIndex() == Results)
        html.prepend(tr("<p style=\"margin:0 0 6px 0\">%1:</p>").arg(table->model().toHtmlEscaped()));
    if (html != m_page->property("shown").toString()) {
        m_page->setProperty("shown", html);
        m_page->setHtml(html);
    }
    m_page->setVisible(m_allModels->isChecked() || !isRefusedShown());
}

/// From what a search found to the model's own table, at that register.
void LibraryDialog::openResult(const QModelIndex &index)
{
    const RegisterIndex::Entry *found = m_results->entry(index);
    if (!found)
        return;
    const QString name = found->name;
    const RegisterIndex::Owner owner = m_results->owner(index);
    m_otherSearch.clear(); // the table whole
    showModel(owner.modelNumber, owner.firmwareTo);
    showRegister(name);
    m_registerView->setFocus(Qt::OtherFocusReason);
}

void LibraryDialog::showRegister(const QString &name)
{
    const int at = m_registers->table() ? m_registers->table()->indexOf(name) : -1;
    const QModelIndex row = m_filtered->mapFromSource(m_registers->indexOf(at, RegisterModel::Name));
    if (!row.isValid())
        return;
    m_registerView->setCurrentIndex(row);
    m_registerView->scrollTo(row, QAbstractItemView::PositionAtCenter);
}

bool LibraryDialog::eventFilter(QObject *watched, QEvent *event)
{
    if (watched == m_search && event->type() == QEvent::KeyPress) {
        const int key = static_cast<QKeyEvent *>(event)->key();
        if (key == Qt::Key_Down || key == Qt::Key_Return || key == Qt::Key_Enter) {
            LibraryView *list = listShown();
            if (!list->currentIndex().isValid())
                list->setCurrentIndex(list->model()->index(0, 0));
            list->setFocus(Qt::TabFocusReason);
            return true;
        }
    }
    return QDialog::eventFilter(watched, event);
}

void LibraryDialog::changeEvent(QEvent *event)
{
    if (event->type() == QEvent::PaletteChange && m_stack)
        refreshPage();
    QDialog::changeEvent(event);
}

void LibraryDialog::done(int result)
{
    QSettings().setValue(GeometryKey, saveGeometry());
    if (m_models->current() >= 0)
        QSettings().setValue(ModelKey, m_models->current());
    QDialog::done(result);
}

} // namespace dynascope
