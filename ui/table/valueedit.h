// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/units.h"

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
    struct Meaning {
        Field field;
        EffectiveField effective;
        int resolution = 4096;
        AngleUnit angle = AngleUnit::Degrees;
        bool physical = false; ///< a bare number is meant in the field's unit, not raw
    };

    ValueEdit(Meaning meaning, const QString &text, std::optional<std::int64_t> raw, QWidget *parent = nullptr);
    ~ValueEdit() override;

    bool isChanged() const; ///< a person did something to the text
    Result<std::int64_t> value() const;

protected:
    void keyPressEvent(QKeyEvent *event) override;
    void wheelEvent(QWheelEvent *event) override;
    void showEvent(QShowEvent *event) override;
    void moveEvent(QMoveEvent *event) override;
    void hideEvent(QHideEvent *event) override;

private:
    QString textOf(std::int64_t raw) const;
    void step(int steps);
    void say();
    void placeHint();

    Meaning m_meaning;
    QString m_initial;
    std::optional<std::int64_t> m_raw;
    QPointer<QLabel> m_hint; ///< beside this in the same parent
};

} // namespace dynascope
