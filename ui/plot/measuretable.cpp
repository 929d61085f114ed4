// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/measuretable.h"

#include "ui/common/theme.h"
#include "ui/plot/measuremodel.h"

#include <QApplication>
#include <QClipboard>
#include <QHeaderView>
#include <QKeyEvent>

#include <algorithm>

namespace dynascope {

namespace {

constexpr int FewestRows = 2, MostRows = 5; ///< more are scrolled
constexpr int Air = 16;                     ///< beside the text of a cell

} // namespace

MeasureTable::MeasureTable(MeasureModel &model, QWidget *parent) : QTableView(parent), m_mostRows(MostRows)
{
    setModel(&model);
    setFrameShape(NoFrame);
    setShowGrid(false);
    setWordWrap(false);
    setSelectionBehavior(SelectRows);
    setTextElideMode(Qt::ElideMiddle);
    setHorizontalScrollMode(ScrollPerPixel);
    setTabKeyNavigation(false);
    setAccessibleName(tr("Figures between the cursors"));
    setFont(numberFont(font()));
    verticalHeader()->hide();
    verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
    verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 6);
    verticalHeader()->setMinimumSectionSize(1);
    horizontalHeader()->setSectionResizeMode(QHeaderView::Fixed);
    horizontalHeader()->setHighlightSections(false);
    horizontalHeader()->setMinimumSectionSize(24);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    connect(&model, &QAbstractItemModel::modelReset, this, &MeasureTable::updateGeometry);
    connect(&model, &QAbstractItemModel::dataChanged, this, &MeasureTable::fitColumns);
    fitColumns();
}

int MeasureTable::heightFor(int rows) const
{
    const int scrollBar = horizontalHeader()->length() > width() ? style()->pixelMetric(QStyle::PM_ScrollBarExtent) : 0;
    return horizontalHeader()->sizeHint().height() + rows * verticalHeader()->defaultSectionSize() + 2 + scrollBar;
}

QSize MeasureTable::sizeHint() const
{
    return {240, heightFor(std::clamp(model()->rowCount(), 1, m_mostRows))};
}

void MeasureTable::setRoom(int height)
{
    const int rows = std::clamp((height - heightFor(0)) / verticalHeader()->defaultSectionSize(), FewestRows, MostRows);
    if (rows == m_mostRows)
        return;
    m_mostRows = rows;
    updateGeometry();
}

QSize MeasureTable::minimumSizeHint() const
{
    return {0, sizeHint().height()};
}

void MeasureTable::fitColumns()
{
    int numbers = 0;
    for (int column = 1; column < model()->columnCount(); ++column) {
        int width = std::max(columnWidth(column) * (model()->rowCount() > 0 ? 1 : 0),
            fontMetrics().horizontalAdvance(QStringLiteral("000.00")) + Air);
        for (int row = 0; row < model()->rowCount(); ++row)
            width = std::max(width, fontMetrics().horizontalAdvance(model()->index(row, column).data().toString()) + Air);
        if (width != columnWidth(column))
            setColumnWidth(column, width);
        numbers += width;
    }
    const int names = std::max(fontMetrics().horizontalAdvance(QStringLiteral("Δt 000.0000 s · 00.000 Hz")) + Air,
        viewport()->width() - numbers);
    if (names != columnWidth(0))
        setColumnWidth(0, names);
}

void MeasureTable::resizeEvent(QResizeEvent *event)
{
    QTableView::resizeEvent(event);
    fitColumns();
    updateGeometry();
}

void MeasureTable::changeEvent(QEvent *event)
{
    QTableView::changeEvent(event);
    if (event->type() == QEvent::PaletteChange)
        viewport()->update();
}

void MeasureTable::copySelected() const
{
    QString text;
    for (int row = 0; row < model()->rowCount(); ++row) {
        if (!selectionModel()->isRowSelected(row))
            continue;
        for (int column = 0; column < model()->columnCount(); ++column)
            text += model()->index(row, column).data().toString() + (column + 1 < model()->columnCount() ? u'\t' : u'\n');
    }
    if (!text.isEmpty())
        QApplication::clipboard()->setText(text.replace(QChar(0x2212), u'-'));
}

void MeasureTable::keyPressEvent(QKeyEvent *event)
{
    if (event->matches(QKeySequence::Copy))
        copySelected();
    else
        QTableView::keyPressEvent(event);
}

} // namespace dynascope
