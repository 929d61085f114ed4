// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/scanner.h"

#include <QFrame>

class QLabel;
class QListWidget;
class QPushButton;
class QSpinBox;

namespace dynascope {

/// Which baud rates and IDs a scan tries. A popup below its button.
class ScanOptions : public QFrame
{
    Q_OBJECT

public:
    explicit ScanOptions(QWidget *parent = nullptr);

    void popup(const QPoint &position);
    /// In the order of likelyBauds(): most promising first.
    ScanRange range(int lastUsedBaud) const;
    void setBauds(const std::vector<int> &bauds);
    void setRatesOffered(bool offered); ///< false: the line has the one rate it has

signals:
    void scanRequested();

private:
    void build();
    void update();
    std::vector<int> checkedBauds() const;

    QWidget *m_rates; ///< all that is about baud rates
    QListWidget *m_bauds;
    QSpinBox *m_firstId;
    QSpinBox *m_lastId;
    QLabel *m_summary;
    QPushButton *m_scan;
};

} // namespace dynascope
