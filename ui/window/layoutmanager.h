// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

class QMainWindow;
class QSplitter;

namespace dynascope {

enum class PlotPlace { Right, Below };

/// Where the plots stand and how wide everything is; remembered in the settings, for either place by itself.
class LayoutManager : public QObject
{
    Q_OBJECT

public:
    /// `outer`: devices | inner; `inner`: table | plots. The window outlives this.
    LayoutManager(QMainWindow &window, QSplitter &outer, QSplitter &inner);

    PlotPlace plotPlace() const { return m_place; }
    void setPlotPlace(PlotPlace place);
    void restore();
    void save() const;
    void reset(); ///< as at the first start

signals:
    void plotPlaceChanged();

private:
    void apply(PlotPlace place);
    void storeInner();
    void setDefaultSizes();

    QMainWindow &m_window;
    QSplitter &m_outer;
    QSplitter &m_inner;
    PlotPlace m_place = PlotPlace::Right;
    QByteArray m_right, m_below; ///< the inner splitter's state at either place
};

} // namespace dynascope
