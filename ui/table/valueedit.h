// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/table/valuemeaning.h"

#include <QLineEdit>
#include <QPointer>

class QLabel;

namespace dynascope {

/// Types a number, raw or with its unit; says at once what it stands for, or why it can't be. Up, Down and the wheel
/// step it.
class ValueEdit : public QLineEdit
{
    Q_OBJECT

public:
    ValueEdit(ValueMeaning meaning, const QString &text, std::optional<std::int64_t> raw, QWidget *parent = nullptr);
    ~ValueEdit() override;

    /// Registers that range and unit depend on have changed meanwhile; the text stays as the person left it.
    void setEffective(const EffectiveField &effective);
    bool isChanged() const; ///< a person did something to the text
    Result<std::int64_t> value() const;

protected:
    void keyPressEvent(QKeyEvent *event) override;
    void wheelEvent(QWheelEvent *event) override;
    void showEvent(QShowEvent *event) override;
    void moveEvent(QMoveEvent *event) override;
    void hideEvent(QHideEvent *event) override;

private:
    void offerRegisters(const ControlTable &table);
    void step(int steps);
    void say();
    void placeHint();

    ValueMeaning m_meaning;
    QString m_initial;
    std::optional<std::int64_t> m_raw;
    QPointer<QLabel> m_hint; ///< beside this in the same parent
};

} // namespace dynascope
