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
    void setPlotPlace(PlotPlace place); ///< by a person; until then the window's width decides
    void restore();
    void save() const;
    void reset(); ///< as at the first start

    bool eventFilter(QObject *watched, QEvent *event) override;

signals:
    void plotPlaceChanged();

private:
    void apply(PlotPlace place);
    void arrange();
    void storeInner();
    void setDefaultSizes();
    PlotPlace fitting() const;

    QMainWindow &m_window;
    QSplitter &m_outer;
    QSplitter &m_inner;
    PlotPlace m_place = PlotPlace::Right;
    bool m_chosen = false;
    QByteArray m_right, m_below; ///< the inner splitter as a person left it at either place; empty: as it fits
};

} // namespace dynascope
