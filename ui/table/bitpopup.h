// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/field.h"

#include <QFrame>

namespace dynascope {

/// A check list of a register's bits; groups of bits are lists. Bits without a name stay as they are. A pop-up: Enter
/// or Write takes it, Esc or a click beside it leaves everything as it was. Deletes itself.
class BitPopup : public QFrame
{
    Q_OBJECT

public:
    BitPopup(const Field &field, std::int64_t raw, QWidget *parent);

    void open(const QPoint &globalPosition);
    std::int64_t value() const { return static_cast<std::int64_t>(m_raw); }

signals:
    void accepted(qint64 raw); ///< only where it differs from what it was

protected:
    void keyPressEvent(QKeyEvent *event) override;

private:
    QWidget *makeRow(const BitField &bits);
    void set(const BitField &bits, std::uint32_t value);
    void accept();

    std::uint32_t m_initial = 0;
    std::uint32_t m_raw = 0;
};

} // namespace dynascope
