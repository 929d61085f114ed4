// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/record/recordbadge.h"

#include "ui/common/icons.h"
#include "ui/common/theme.h"
#include "ui/record/recordtexts.h"
#include "ui/record/sessionrecorder.h"
#include "ui/record/sessionstream.h"

#include <QAction>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include <algorithm>

namespace dynascope {
namespace {

using namespace std::chrono_literals;

constexpr auto Refresh = 250ms;
constexpr int DotSize = 14;

int widthOf(const QLabel &label, const QString &text)
{
    return QFontMetrics(label.font()).horizontalAdvance(text);
}

} // namespace

RecordBadge::RecordBadge(const SessionRecorder &recorder, const SessionStream &stream, QAction &record, QWidget *parent)
    : QWidget(parent)
    , m_recorder(recorder)
    , m_stream(stream)
    , m_button(new QToolButton(this))
{
    setObjectName(QStringLiteral("recordBadge"));
    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 8, 0);
    layout->setSpacing(6);
    m_streaming = addLabel(QStringLiteral("streamPlace"), tr("Streaming"));
    m_dot = addLabel(QStringLiteral("recordDot"), {});
    m_word = addLabel(QStringLiteral("recordWord"), {});
    m_time = addLabel(QStringLiteral("recordTime"), tr("Length of the recording"));
    m_size = addLabel(QStringLiteral("recordSize"), tr("Size of the recording"));
    for (QLabel *figure : {m_time, m_size}) {
        figure->setFont(numberFont(font()));
        figure->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    }
    m_time->setFixedWidth(widthOf(*m_time, QStringLiteral("000:00:00")));
    m_size->setFixedWidth(widthOf(*m_size, QStringLiteral("0000.0 MB")));
    m_word->setFont(boldened(font()));
    m_button->setObjectName(QStringLiteral("recordButton"));
    m_button->setAutoRaise(true);
    m_button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    m_button->setIconSize({16, 16});
    m_button->setDefaultAction(&record);
    // As wide as its longest text, or it would shrink away from under the pointer.
    const QFontMetrics metrics(m_button->font());
    m_button->setFixedWidth(m_button->sizeHint().width() + metrics.averageCharWidth()
                            + std::max(0, metrics.horizontalAdvance(tr("End recording"))
                                           - metrics.horizontalAdvance(record.iconText())));
    layout->addWidget(m_button);
    m_timer.setInterval(Refresh);
    connect(&m_timer, &QTimer::timeout, this, &RecordBadge::update);
    connect(&recorder, &SessionRecorder::changed, this, &RecordBadge::update);
    connect(&recorder, &SessionRecorder::ended, this, &RecordBadge::update);
    connect(&stream, &SessionStream::changed, this, &RecordBadge::update);
    colour();
    update();
}

QLabel *RecordBadge::addLabel(const QString &name, const QString &accessible)
{
    auto *label = new QLabel(this);
    label->setObjectName(name);
    label->setAccessibleName(accessible);
    label->setTextFormat(Qt::PlainText);
    layout()->addWidget(label);
    return label;
}

void RecordBadge::changeEvent(QEvent *event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && m_size) // not while it is made
        colour();
}

void RecordBadge::colour()
{
    m_dot->setPixmap(icon(QStringLiteral("record"), IconTint::Bad).pixmap(QSize(DotSize, DotSize), devicePixelRatioF()));
    QPalette ink = palette();
    ink.setColor(QPalette::WindowText, colors(palette()).bad);
    m_word->setPalette(ink);
    m_time->setPalette(ink);
}

void RecordBadge::update()
{
    const bool runs = m_recorder.isRunning();
    const bool ends = m_recorder.isEnding();
    for (QLabel *label : {m_dot, m_word, m_time, m_size})
        label->setVisible(runs || ends);
    m_streaming->setVisible(m_stream.isRunning());
    if (m_stream.isRunning())
        m_streaming->setText(tr("JSON → %1").arg(m_stream.wishes().place()));
    if (!runs && !ends) {
        m_timer.stop();
        return;
    }
    if (!m_timer.isActive())
        m_timer.start();
    const RecorderStatus status = m_recorder.status();
    m_word->setText(ends ? tr("Writing") : tr("Recording"));
    m_time->setText(lengthText(m_recorder.length()));
    m_size->setText(sizeText(status.bytes));
    const QString tip = status.lost > 0 ? tr("%1\n%2 samples so far, %3 lost").arg(status.path).arg(status.samples).arg(status.lost)
                                        : tr("%1\n%2 samples so far").arg(status.path).arg(status.samples);
    for (QLabel *label : {m_word, m_time, m_size})
        label->setToolTip(tip);
}

} // namespace dynascope
