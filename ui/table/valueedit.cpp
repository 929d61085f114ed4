// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/valueedit.h"

#include "ui/common/theme.h"

#include <QKeyEvent>
#include <QLabel>
#include <QWheelEvent>

#include <algorithm>

namespace dynascope {

ValueEdit::ValueEdit(Meaning meaning, const QString &text, std::optional<std::int64_t> raw, QWidget *parent)
    : QLineEdit(text, parent)
    , m_meaning(std::move(meaning))
    , m_initial(text)
    , m_raw(raw)
{
    setObjectName(QStringLiteral("valueEdit"));
    setAccessibleName(m_meaning.field.name);
    setFont(numberFont(font()));
    setAlignment(Qt::AlignRight);
    setMaxLength(64);
    connect(this, &QLineEdit::textChanged, this, &ValueEdit::say);
}

ValueEdit::~ValueEdit()
{
    delete m_hint;
}

bool ValueEdit::isChanged() const
{
    return text().trimmed() != m_initial.trimmed();
}

Result<std::int64_t> ValueEdit::value() const
{
    QString typed = text().trimmed();
    bool isBare = false;
    typed.toDouble(&isBare);
    if (isBare && m_meaning.physical)
        typed += unitSymbol(m_meaning.effective.unit, m_meaning.angle);
    return parseValue(m_meaning.field, m_meaning.effective, m_meaning.resolution, typed, m_meaning.angle);
}

QString ValueEdit::textOf(std::int64_t raw) const
{
    return m_meaning.physical
        ? valueText(m_meaning.field, m_meaning.effective, m_meaning.resolution, raw, m_meaning.angle)
        : QString::number(raw);
}

void ValueEdit::step(int steps)
{
    const auto now = value();
    if (!now && !m_raw)
        return;
    const std::int64_t least = m_meaning.effective.minimum.value_or(smallestRaw(m_meaning.field));
    const std::int64_t most = m_meaning.effective.maximum.value_or(largestRaw(m_meaning.field));
    setText(textOf(std::clamp((now ? *now : *m_raw) + steps, least, std::max(least, most))));
    selectAll();
}

void ValueEdit::keyPressEvent(QKeyEvent *event)
{
    switch (event->key()) {
    case Qt::Key_Up: return step(1);
    case Qt::Key_Down: return step(-1);
    case Qt::Key_PageUp: return step(10);
    case Qt::Key_PageDown: return step(-10);
    default: QLineEdit::keyPressEvent(event);
    }
}

void ValueEdit::wheelEvent(QWheelEvent *event)
{
    if (hasFocus() && event->angleDelta().y() != 0)
        step(event->angleDelta().y() > 0 ? 1 : -1);
    event->accept();
}

void ValueEdit::say()
{
    if (!m_hint && parentWidget()) {
        m_hint = new QLabel(parentWidget());
        m_hint->setObjectName(QStringLiteral("valueHint"));
        m_hint->setTextFormat(Qt::PlainText);
        m_hint->setWordWrap(true);
        m_hint->setMargin(6);
        m_hint->setAutoFillBackground(true);
        m_hint->setBackgroundRole(QPalette::Window); // else both follow the grid's
        m_hint->setForegroundRole(QPalette::WindowText);
        m_hint->setFrameShape(QFrame::StyledPanel);
    }
    if (!m_hint)
        return;
    const auto now = value();
    QPalette colours = palette();
    colours.setColor(QPalette::Window, palette().color(QPalette::ToolTipBase));
    colours.setColor(QPalette::WindowText, now ? palette().color(QPalette::ToolTipText) : colors(palette()).bad);
    m_hint->setPalette(colours);
    if (now) {
        const QString text
            = valueText(m_meaning.field, m_meaning.effective, m_meaning.resolution, *now, m_meaning.angle);
        const QString raw = QString::number(*now);
        m_hint->setText(text == raw ? tr("Enter writes %1").arg(raw) : tr("Enter writes %1 = raw %2").arg(text, raw));
    } else {
        m_hint->setText(now.error().text);
    }
    m_hint->setVisible(isVisible() && isChanged());
    placeHint();
}

void ValueEdit::placeHint()
{
    if (!m_hint)
        return;
    const QWidget *around = parentWidget();
    const int width = std::clamp(m_hint->fontMetrics().horizontalAdvance(m_hint->text()) + 24, 140, 360);
    const QSize size(width, m_hint->heightForWidth(width));
    const bool below = geometry().bottom() + 2 + size.height() <= around->height();
    const int top = below ? geometry().bottom() + 2 : geometry().top() - 2 - size.height();
    const int left = std::clamp(geometry().right() - size.width() + 1, 0, std::max(0, around->width() - size.width()));
    m_hint->setGeometry(QRect(QPoint(left, top), size));
    m_hint->raise();
}

void ValueEdit::showEvent(QShowEvent *event)
{
    QLineEdit::showEvent(event);
    selectAll();
    say();
}

void ValueEdit::moveEvent(QMoveEvent *event)
{
    QLineEdit::moveEvent(event);
    placeHint();
}

void ValueEdit::hideEvent(QHideEvent *event)
{
    QLineEdit::hideEvent(event);
    if (m_hint)
        m_hint->hide();
}

} // namespace dynascope
