// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/controltable.h"

#include <QComboBox>

namespace dynascope {

/// The list of an enumerated register's values that may be written. Open at once; picking one or dismissing the list
/// ends it.
class EnumEdit : public QComboBox
{
    Q_OBJECT

public:
    EnumEdit(const Field &field, const EffectiveField &effective, std::optional<std::int64_t> raw,
             QWidget *parent = nullptr);

    bool isPicked() const { return m_picked; } ///< by a person
    std::int64_t value() const { return currentData().toLongLong(); }
    void hidePopup() override;

signals:
    void finished(); ///< from the event loop, once

protected:
    void showEvent(QShowEvent *event) override;

private:
    bool m_picked = false;
    bool m_finished = false;
};

} // namespace dynascope
