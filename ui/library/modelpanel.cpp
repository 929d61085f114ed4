// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/modelpanel.h"

#include "ui/common/icons.h"
#include "ui/common/texts.h"
#include "ui/common/theme.h"
#include "ui/library/modeldelegate.h"

#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QSortFilterProxyModel>
#include <QStackedWidget>
#include <QStandardItemModel>
#include <QTreeView>
#include <QVBoxLayout>

#include <algorithm>
#include <set>
#include <tuple>

namespace dynascope {
namespace {

constexpr int RowHeight = 26;
constexpr int NumberWidth = 56;

enum Role {
    ModelNumberRole = Qt::UserRole, ///< int: the model's number; missing for series and files
    MessageRole,                    ///< QString: why a file was refused
    WordsRole,                      ///< QString: what the filter looks in, names without spaces and '-'
};

/// Rows in which all the words are, and what is above them.
class ModelFilter : public QSortFilterProxyModel
{
public:
    explicit ModelFilter(QObject *parent) : QSortFilterProxyModel(parent)
    {
        setRecursiveFilteringEnabled(true);
        setAutoAcceptChildRows(true); // a series that is named shows all it has
    }

    void setWords(const QStringList &words)
    {
        m_words = words;
        invalidateRowsFilter();
    }

protected:
    bool filterAcceptsRow(int row, const QModelIndex &parent) const override
    {
        const QString text = sourceModel()->index(row, 0, parent).data(WordsRole).toString();
        return std::ranges::all_of(m_words, [&text](const QString &word) { return text.contains(word); });
    }

private:
    QStringList m_words;
};

QString wordsOf(const QStringList &names)
{
    QStringList plain;
    for (const QString &name : names)
        plain << normalizedName(name);
    return plain.join(u' ');
}

QString modelTip(const Catalog::ModelInfo &info)
{
    QStringList lines{ModelPanel::tr("%1, model number %2").arg(info.model).arg(info.modelNumber)};
    if (!info.alsoCalled.isEmpty())
        lines << ModelPanel::tr("Also called %1").arg(info.alsoCalled.join(QStringLiteral(", ")));
    if (info.addressesOnly)
        lines << ModelPanel::tr("Only names, addresses and sizes are public");
    if (!info.isBuiltIn)
        lines << ModelPanel::tr("Your own, from %1.json").arg(info.file);
    return plainToolTip(lines.join(u'\n'));
}

} // namespace

ModelPanel::ModelPanel(const Catalog &catalog, const std::vector<RefusedTable> &refused, QWidget *parent)
    : QWidget(parent)
    , m_model(new QStandardItemModel(0, 2, this))
    , m_shown(new ModelFilter(this))
    , m_filter(new QLineEdit(this))
    , m_view(new QTreeView(this))
    , m_empty(new QLabel(this))
    , m_stack(new QStackedWidget(this))
{
    fill(catalog);
    fillRefused(refused);
    m_filter->setObjectName(QStringLiteral("modelFilter"));
    m_filter->setAccessibleName(tr("Filter the models"));
    m_filter->setPlaceholderText(tr("Filter models"));
    m_filter->setToolTip(tr("Name, number, series, or another name of the model"));
    m_filter->setClearButtonEnabled(true);
    m_filter->addAction(icon(QStringLiteral("filter"), IconTint::Dimmed), QLineEdit::LeadingPosition);
    m_filter->installEventFilter(this);
    connect(m_filter, &QLineEdit::textChanged, this, &ModelPanel::filter);
    makeView();
    m_empty->setObjectName(QStringLiteral("modelsEmpty"));
    m_empty->setAlignment(Qt::AlignHCenter | Qt::AlignTop);
    m_empty->setContentsMargins(12, 24, 12, 0);
    m_empty->setWordWrap(true);
    m_empty->setTextFormat(Qt::PlainText);
    m_empty->setForegroundRole(QPalette::PlaceholderText);
    m_stack->addWidget(m_view);
    m_stack->addWidget(m_empty);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    auto *top = new QVBoxLayout;
    top->setContentsMargins(8, 8, 8, 8);
    top->addWidget(m_filter);
    layout->addLayout(top);
    layout->addWidget(m_stack, 1);
}

QStandardItem *ModelPanel::group(const QString &title)
{
    for (int row = 0; row < m_model->rowCount(); ++row) {
        if (m_model->item(row)->text() == title)
            return m_model->item(row);
    }
    auto *item = new QStandardItem(title); // the model owns it
    auto *count = new QStandardItem;
    for (QStandardItem *each : {item, count})
        each->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
    item->setData(normalizedName(title), WordsRole);
    item->setSizeHint(QSize(0, RowHeight));
    QFont bold = font();
    bold.setWeight(QFont::DemiBold);
    item->setFont(bold);
    m_model->appendRow({item, count});
    return item;
}

void ModelPanel::add(const Catalog::ModelInfo &info)
{
    auto *name = new QStandardItem(info.model);
    auto *number = new QStandardItem(QString::number(info.modelNumber));
    for (QStandardItem *each : {name, number}) {
        each->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
        each->setToolTip(modelTip(info));
        each->setData(info.modelNumber, ModelNumberRole);
    }
    name->setData(wordsOf(QStringList{info.model, QString::number(info.modelNumber)} + info.alsoCalled), WordsRole);
    name->setSizeHint(QSize(0, RowHeight));
    if (!info.isBuiltIn) {
        name->setIcon(icon(QStringLiteral("folder"), IconTint::Accent));
        name->setData(tr("%1, your own").arg(info.model), Qt::AccessibleTextRole);
    }
    number->setFont(numberFont(font()));
    number->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    number->setForeground(palette().color(QPalette::PlaceholderText));
    group(info.series)->appendRow({name, number});
}

/// Series by name, those of which only addresses are public last; models by name.
void ModelPanel::fill(const Catalog &catalog)
{
    std::vector<Catalog::ModelInfo> models = catalog.models();
    std::set<QString> described;
    for (const Catalog::ModelInfo &info : models) {
        if (!info.addressesOnly)
            described.insert(info.series);
    }
    std::ranges::sort(models, {}, [&described](const Catalog::ModelInfo &info) {
        return std::tuple(!described.contains(info.series), info.series, info.model);
    });
    for (const Catalog::ModelInfo &info : models)
        add(info);
    for (int series = 0; series < m_model->rowCount(); ++series) {
        const QStandardItem &of = *m_model->item(series);
        QStringList names;
        for (int row = 0; row < of.rowCount(); ++row)
            names << of.child(row)->text();
        const QStringList brief = shortNames(names);
        for (int row = 0; row < of.rowCount(); ++row) {
            if (!brief[row].isEmpty())
                of.child(row)->setData(brief[row], ModelDelegate::ShortRole);
        }
    }
}

void ModelPanel::fillRefused(const std::vector<RefusedTable> &refused)
{
    for (const RefusedTable &one : refused) {
        auto *file = new QStandardItem(icon(QStringLiteral("warning"), IconTint::Warning), one.file);
        file->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
        file->setData(one.text, MessageRole);
        file->setData(normalizedName(one.file), WordsRole);
        file->setToolTip(plainToolTip(one.text));
        file->setSizeHint(QSize(0, RowHeight));
        group(tr("Files not read"))->appendRow({file, new QStandardItem});
    }
}

void ModelPanel::makeView()
{
    m_shown->setSourceModel(m_model);
    m_view->setObjectName(QStringLiteral("modelView"));
    m_view->setAccessibleName(tr("Models"));
    m_view->setFrameShape(QFrame::NoFrame);
    m_view->setHeaderHidden(true);
    m_view->setUniformRowHeights(true);
    m_view->setIndentation(12);
    m_view->setTextElideMode(Qt::ElideMiddle);
    m_view->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_view->setAllColumnsShowFocus(true);
    m_view->setItemDelegate(new ModelDelegate(m_view)); // the view owns it
    m_view->setModel(m_shown);
    m_view->header()->setStretchLastSection(false);
    m_view->header()->setMinimumSectionSize(NumberWidth);
    m_view->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    m_view->header()->setSectionResizeMode(1, QHeaderView::Fixed);
    m_view->header()->resizeSection(1, NumberWidth);
    connect(m_view->selectionModel(), &QItemSelectionModel::currentChanged, this, &ModelPanel::choose);
    connect(m_view, &QTreeView::clicked, this, &ModelPanel::choose); // again, after a search over all models
    m_view->expandAll();
}

QModelIndex ModelPanel::firstModel(const QModelIndex &below) const
{
    for (int row = 0; row < m_shown->rowCount(below); ++row) {
        const QModelIndex index = m_shown->index(row, 0, below);
        if (index.data(ModelNumberRole).isValid())
            return index;
        if (const QModelIndex deeper = firstModel(index); deeper.isValid())
            return deeper;
    }
    return {};
}

void ModelPanel::filter(const QString &text)
{
    QStringList words;
    for (const QString &word : text.split(u' ', Qt::SkipEmptyParts))
        words << normalizedName(word);
    static_cast<ModelFilter *>(m_shown)->setWords(words);
    m_view->expandAll();
    const bool any = m_shown->rowCount() > 0;
    m_empty->setText(tr("No model has “%1” in its name or number.").arg(text.trimmed()));
    m_stack->setCurrentWidget(any ? static_cast<QWidget *>(m_view) : m_empty);
    if (m_view->currentIndex().isValid())
        m_view->scrollTo(m_view->currentIndex());
}

void ModelPanel::select(int modelNumber)
{
    const auto find = [this, modelNumber] {
        const QModelIndexList found = m_shown->match(m_shown->index(0, 0), ModelNumberRole, modelNumber, 1,
                                                     Qt::MatchExactly | Qt::MatchRecursive);
        return found.isEmpty() ? QModelIndex() : found.front();
    };
    QModelIndex index = find();
    if (!index.isValid()) {
        m_filter->clear();
        index = find();
    }
    if (!index.isValid())
        return;
    m_view->setCurrentIndex(index);
    m_view->scrollTo(index);
}

int ModelPanel::current() const
{
    const QVariant number = m_view->currentIndex().siblingAtColumn(0).data(ModelNumberRole);
    return number.isValid() ? number.toInt() : -1;
}

void ModelPanel::choose(const QModelIndex &index)
{
    const QModelIndex row = index.siblingAtColumn(0);
    if (const QVariant number = row.data(ModelNumberRole); number.isValid())
        emit modelChosen(number.toInt());
    else if (const QVariant message = row.data(MessageRole); message.isValid())
        emit refusedChosen(row.data().toString(), message.toString());
}

/// Down and Enter go from the filter to the models; Enter chooses the first that is left.
bool ModelPanel::eventFilter(QObject *watched, QEvent *event)
{
    if (watched == m_filter && event->type() == QEvent::KeyPress) {
        const int key = static_cast<QKeyEvent *>(event)->key();
        if (key == Qt::Key_Down || key == Qt::Key_Return || key == Qt::Key_Enter) {
            const bool stays = current() >= 0 && m_filter->text().isEmpty();
            if (const QModelIndex first = firstModel({}); first.isValid() && !stays)
                m_view->setCurrentIndex(first);
            m_view->setFocus(Qt::TabFocusReason);
            return true;
        }
    }
    return QWidget::eventFilter(watched, event);
}

} // namespace dynascope
