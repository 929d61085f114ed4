// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/valueedit.h"

#include "core/table/indirect.h"
#include "ui/common/theme.h"

#include <QCompleter>
#include <QKeyEvent>
#include <QLabel>
#include <QWheelEvent>

#include <algorithm>

namespace dynascope {

ValueEdit::ValueEdit(ValueMeaning meaning, const QString &text, std::optional<std::int64_t> raw, QWidget *parent)
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
    if (m_meaning.pointsInto)
        offerRegisters(*m_meaning.pointsInto);
    connect(this, &QLineEdit::textChanged, this, &ValueEdit::say);
}

ValueEdit::~ValueEdit()
{
    delete m_hint;
}

void ValueEdit::offerRegisters(const ControlTable &table)
{
    QStringList names;
    for (const Field &field : table.fields()) {
        if (checkRange(m_meaning.field, m_meaning.effective, field.address) && indirectDataNumber(field) == 0)
            names << field.name;
    }
    auto *completer = new QCompleter(names, this);
    completer->setCaseSensitivity(Qt::CaseInsensitive);
    completer->setFilterMode(Qt::MatchContains);
    completer->setMaxVisibleItems(12);
    setCompleter(completer);
    setAlignment(Qt::AlignLeft); // words
}

bool ValueEdit::isChanged() const
{
    return text().trimmed() != m_initial.trimmed();
}

Result<std::int64_t> ValueEdit::value() const
{
    return m_meaning.value(text());
}

void ValueEdit::setEffective(const EffectiveField &effective)
{
    if (effective == m_meaning.effective)
        return;
    m_meaning.effective = effective;
    say();
}

void ValueEdit::step(int steps)
{
    const auto now = value();
    if (!now && !m_raw)
        return;
    const auto [least, most] = signedRange(m_meaning.field, m_meaning.effective);
    const std::int64_t from = signedFromRaw(m_meaning.effective, now ? *now : *m_raw);
    setText(m_meaning.text(rawFromSigned(m_meaning.effective, std::clamp(from + steps, least, most))));
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
        const QString text = m_meaning.said(*now);
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
    // Below are the names that fit, where names are typed.
    const bool fitsAbove = geometry().top() - 2 - size.height() >= 0;
    const bool fitsBelow = geometry().bottom() + 2 + size.height() <= around->height();
    const bool below = completer() ? !fitsAbove : fitsBelow;
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
