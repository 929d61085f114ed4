// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/spanmeasure.h"
#include "ui/plot/plotcursors.h"

#include <QAbstractTableModel>
#include <QPalette>

namespace dynascope {

/// What is at the two cursors and between them, a row for each visible trace. Measures a bounded number of samples at a
/// time, so that millions take their while and the plot none.
class MeasureModel : public QAbstractTableModel
{
    Q_OBJECT

public:
    enum Column { Name, AtA, AtB, Change, Mean, Minimum, Maximum, Rms, Frequency, ColumnCount };

    explicit MeasureModel(QObject *parent = nullptr);

    /// Looks at no more samples than `budget` has left. True: all that was asked for is measured.
    bool measure(
        const std::vector<TraceData> &traces, const PlotCursors &cursors, LineTime zero, std::size_t &budget);
    void show(); ///< the figures as they are now: no faster than can be read

    int rowCount(const QModelIndex &parent = {}) const override;
    int columnCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    struct Row {
        SpanMeasure measure;
        QString label, unit;
        QColor color, shownColor;
        double scale = 1, offset = 0;
        int decimals = 0;
        std::optional<double> ends[2];
        std::array<QString, ColumnCount> texts;
    };

    void describe(Row &row, const TraceData &trace, const PlotCursors &cursors, LineTime zero) const;
    static std::array<QString, ColumnCount> textsOf(const Row &row);

    std::vector<Row> m_rows;
    std::size_t m_next = 0; ///< whose turn it is: each gets on where one takes long
    QString m_distance;     ///< the header's
    QString m_shownDistance;
};

} // namespace dynascope
