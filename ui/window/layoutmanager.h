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
    struct Splitters {
        QSplitter &whole; ///< outer above Bus health
        QSplitter &outer; ///< devices | inner
        QSplitter &inner; ///< table | plots
    };

    /// The window outlives this.
    LayoutManager(QMainWindow &window, const Splitters &splitters);

    PlotPlace plotPlace() const { return m_place; }
    void setPlotPlace(PlotPlace place); ///< by a person; until then the window's width decides
    bool isHealthShown() const { return m_healthShown; }
    void setHealthShown(bool shown);
    void restore();
    void save() const;
    void reset(); ///< as at the first start

    bool eventFilter(QObject *watched, QEvent *event) override;

signals:
    void plotPlaceChanged();
    void healthShownChanged();

private:
    void apply(PlotPlace place);
    void arrange();
    void arrangeHealth();
    void storeInner();
    void setDefaultSizes();
    PlotPlace fitting() const;

    QMainWindow &m_window;
    QSplitter &m_whole;
    QSplitter &m_outer;
    QSplitter &m_inner;
    PlotPlace m_place = PlotPlace::Right;
    bool m_chosen = false;
    bool m_healthShown = false;
    QByteArray m_health; ///< the whole splitter as a person left it; empty: as it fits
    QByteArray m_right, m_below; ///< the inner splitter as a person left it at either place; empty: as it fits
};

} // namespace dynascope
