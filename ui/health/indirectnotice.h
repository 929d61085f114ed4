// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/common/messagebar.h"

namespace dynascope {

class IndirectReads;
class LineSession;

/// What came of reading by indirect addresses, and what a program that was ended has left in devices.
class IndirectNotice : public QObject
{
    Q_OBJECT

public:
    /// All outlive this or end it.
    IndirectNotice(IndirectReads &reads, MessageBar &messages, QObject *parent);

private:
    void say(LineSession &line);

    IndirectReads &m_reads;
    MessageBar &m_messages;
};

} // namespace dynascope
