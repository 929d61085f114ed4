// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/device.h"
#include "core/session/procedures/moveplan.h"

#include <QWidget>

#include <functional>
#include <map>

class QComboBox;
class QPushButton;
class QSpinBox;
class QTableWidget;

namespace dynascope {

/// Who shall go where: a row for each device with the ID and baud rate it has and those it shall have, and helpers for
/// many rows at once. Once a plan is under way it shows that, and nothing can be changed.
class MoveWishes : public QWidget
{
    Q_OBJECT

public:
    explicit MoveWishes(QWidget *parent = nullptr);

    /// `offers`: can the port do this rate? Rows that are there keep what was wished.
    void setDevices(const std::vector<const Device *> &devices, const std::function<bool(int)> &offers);
    void showPlan(const MovePlan &plan);
    std::map<DeviceKey, MovePlace> wishes() const;
    QString leftOut() const { return m_leftOut; } ///< whom the last wish of one baud rate for all left out, if any

signals:
    void changed(); ///< by a person

private:
    struct Row {
        DeviceKey key = 0;
        QSpinBox *id = nullptr;
        QComboBox *baud = nullptr;
    };

    QWidget *makeHelpers();
    void makeTable();
    void addRow(const Device &device, const std::function<bool(int)> &offers);
    void setText(int row, int column, const QString &text);
    void setFixed(bool fixed);
    std::vector<std::size_t> chosen() const; ///< the selected rows, or all where none is
    void number();
    void allToBaud();
    void swap();
    void updateHelpers();
    bool eventFilter(QObject *watched, QEvent *event) override;

    QWidget *m_helpers;
    QSpinBox *m_first;
    QPushButton *m_number;
    QComboBox *m_baud;
    QPushButton *m_allToBaud;
    QPushButton *m_swap;
    QTableWidget *m_table;
    std::vector<Row> m_rows;
    QString m_leftOut;
};

} // namespace dynascope
