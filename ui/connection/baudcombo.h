// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QComboBox>

namespace dynascope {

/// The working baud rate: the usual ones, or any number typed ("1M", "57600", "57 600 bps").
class BaudCombo : public QComboBox
{
    Q_OBJECT

public:
    explicit BaudCombo(QWidget *parent = nullptr);

    int baudRate() const; ///< 0 where what is typed is no rate
    void setBaudRate(int bitsPerSecond);

    static int parse(const QString &text); ///< 0 where it is no rate between 1200 and 12 M

signals:
    void baudRateChosen(int bitsPerSecond); ///< by a person: from the list, or by Enter
};

} // namespace dynascope
