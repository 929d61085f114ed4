// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/record/streamdialog.h"

#include "ui/common/icons.h"
#include "ui/common/texts.h"
#include "ui/common/theme.h"
#include "ui/record/sessionstream.h"

#include <QDialogButtonBox>
#include <QEvent>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>

namespace dynascope {
namespace {

using namespace std::chrono_literals;

constexpr auto StatusInterval = 500ms;
constexpr int IconSize = 16;
constexpr int LongestHost = 64;
constexpr int TextLetters = 56;

} // namespace

StreamDialog::StreamDialog(SessionStream &stream, QWidget *parent)
    : QDialog(parent)
    , m_stream(stream)
    , m_host(new QLineEdit(this))
    , m_port(new QSpinBox(this))
    , m_warningIcon(new QLabel(this))
    , m_warning(new QLabel(this))
    , m_state(new QLabel(this))
    , m_toggle(new QPushButton(this))
{
    setObjectName(QStringLiteral("streamDialog"));
    setWindowTitle(tr("Stream as JSON over UDP"));
    const StreamWishes wishes = stream.isRunning() ? stream.wishes() : StreamWishes::saved();
    m_host->setObjectName(QStringLiteral("streamHost"));
    m_host->setMaxLength(LongestHost);
    m_host->setText(wishes.host);
    m_port->setObjectName(QStringLiteral("streamPort"));
    m_port->setRange(1, 0xFFFF);
    m_port->setValue(wishes.port);
    m_warning->setObjectName(QStringLiteral("streamWarning"));
    m_state->setObjectName(QStringLiteral("streamState"));
    m_toggle->setObjectName(QStringLiteral("streamToggle"));
    m_toggle->setDefault(true);
    for (QLabel *label : {m_warning, m_state}) {
        label->setTextFormat(Qt::PlainText);
        label->setWordWrap(true);
        label->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    }
    build();
    connect(m_host, &QLineEdit::textChanged, this, [this] {
        m_failure.clear();
        update();
    });
    connect(m_port, &QSpinBox::valueChanged, this, &StreamDialog::update);
    connect(m_toggle, &QPushButton::clicked, this, &StreamDialog::toggle);
    connect(&stream, &SessionStream::changed, this, &StreamDialog::update);
    m_timer.setInterval(StatusInterval);
    connect(&m_timer, &QTimer::timeout, this, &StreamDialog::update);
    m_timer.start();
    update();
}

void StreamDialog::build()
{
    auto *what = new QLabel(tr("Sends what is plotted, in physical units, one datagram a cycle, as PlotJuggler's UDP server "
                               "takes it. Ends with the program."), this);
    what->setWordWrap(true);
    auto *form = new QFormLayout(this);
    form->addRow(what);
    form->addRow(tr("&Host (IP address)"), m_host);
    form->addRow(tr("&Port"), m_port);
    auto *warning = new QHBoxLayout;
    warning->setSpacing(8);
    warning->addWidget(m_warningIcon, 0, Qt::AlignTop);
    warning->addWidget(m_warning, 1);
    form->addRow(warning);
    form->addRow(m_state);
    // As high as its longest text: nothing moves while somebody types.
    const int width = fontMetrics().averageCharWidth() * TextLetters;
    what->setMinimumWidth(width);
    m_warning->setMinimumHeight(3 * fontMetrics().lineSpacing());
    m_state->setMinimumHeight(2 * fontMetrics().lineSpacing());
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    buttons->addButton(m_toggle, QDialogButtonBox::ActionRole);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    form->addRow(buttons);
}

StreamWishes StreamDialog::wishes() const
{
    StreamWishes wishes;
    wishes.host = m_host->text().trimmed();
    wishes.port = m_port->value();
    return wishes;
}

void StreamDialog::toggle()
{
    m_failure.clear();
    if (m_stream.isRunning()) {
        m_stream.stop();
        return;
    }
    if (const auto started = m_stream.start(wishes()); started)
        wishes().save();
    else
        m_failure = asSentence(started.error().text);
    update();
}

void StreamDialog::changeEvent(QEvent *event)
{
    QDialog::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && m_toggle)
        update();
}

void StreamDialog::update()
{
    const bool runs = m_stream.isRunning();
    m_host->setEnabled(!runs);
    m_port->setEnabled(!runs);
    const bool stays = wishes().isThisMachine() || wishes().host.isEmpty();
    m_warning->setText(stays ? tr("Only programs on this computer receive it.")
                             : tr("Leaves this computer: whoever is on the way to %1 can read it, for it is neither encrypted "
                                  "nor signed.").arg(wishes().host));
    m_warningIcon->setPixmap(icon(stays ? QStringLiteral("info") : QStringLiteral("warning"),
                                  stays ? IconTint::Dimmed : IconTint::Warning).pixmap(IconSize, IconSize));
    m_toggle->setText(runs ? tr("&Stop streaming") : tr("&Start streaming"));
    m_toggle->setEnabled(runs || !wishes().host.isEmpty());
    if (!m_failure.isEmpty())
        m_state->setText(m_failure);
    else if (!runs)
        m_state->setText(tr("Nothing is sent."));
    else if (m_stream.lost() > 0)
        m_state->setText(tr("%1 datagrams sent to %2, %3 of them not taken by the system.")
                             .arg(grouped(m_stream.sent()), m_stream.wishes().place(), grouped(m_stream.lost())));
    else
        m_state->setText(tr("%1 datagrams sent to %2.").arg(grouped(m_stream.sent()), m_stream.wishes().place()));
}

} // namespace dynascope
