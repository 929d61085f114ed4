// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/health/indirectnotice.h"

#include "core/session/indirectreads.h"
#include "ui/common/texts.h"

#include <QPointer>

namespace dynascope {
namespace {

QString topicOf(const LineSession &line)
{
    return QStringLiteral("indirect addresses on %1").arg(line.name());
}

} // namespace

IndirectNotice::IndirectNotice(IndirectReads &reads, MessageBar &messages, QObject *parent)
    : QObject(parent)
    , m_reads(reads)
    , m_messages(messages)
{
    connect(&reads, &IndirectReads::told, this, [this](const QString &text, bool isProblem) {
        m_messages.post(isProblem ? MessageKind::Warning : MessageKind::Success, text);
    });
    connect(&reads, &IndirectReads::leftFound, this, [this](LineSession *line) { say(*line); });
    connect(&reads, &IndirectReads::changed, this, [this](LineSession *line) {
        if (m_reads.left(*line).empty())
            m_messages.retractTopic(topicOf(*line));
    });
}

void IndirectNotice::say(LineSession &line)
{
    QStringList names;
    for (const Device *device : m_reads.left(line))
        names << device->displayName();
    Message message;
    message.kind = MessageKind::Warning;
    message.topic = topicOf(line);
    message.text = tr("Indirect Addresses that were set to read faster were not put back: %1")
                       .arg(names.join(QStringLiteral(", ")));
    message.actionText = tr("Put back");
    message.action = [this, where = QPointer<LineSession>(&line)] {
        if (where)
            m_reads.putBackLeft(*where);
    };
    message.otherText = tr("Forget");
    message.other = [this, where = QPointer<LineSession>(&line)] {
        if (!where)
            return;
        m_reads.forgetLeft(*where);
        m_messages.retractTopic(topicOf(*where));
    };
    m_messages.post(message);
}

} // namespace dynascope
