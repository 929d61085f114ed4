// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/fakeline.h"

/// A few bytes of registers behind a FakeLine: enough of a servo for tests of who asks what and when. Answers with the
/// oracle's packets, so that nothing here is taken from core. The real thing is the simulated bus.
class FakeServos
{
public:
    struct Servo {
        int baudRate = 1'000'000;
        dynascope::Bytes registers = dynascope::Bytes(256, 0);
        bool silent = false; ///< hears, obeys, doesn't answer
        bool deaf = false;   ///< neither
        bool onlyPing = false; ///< hears and obeys, answers nothing else: Status Return Level 0
        bool knowsFast = true;
    };

    explicit FakeServos(FakeLine &line) : m_line(line)
    {
        line.handler = [this](const dynascope::Bytes &request) { return answer(request); };
    }

    std::map<int, Servo> servos; ///< by ID

    FakeLine::Answer answer(const dynascope::Bytes &request);

private:
    FakeLine::Answer chain(const std::vector<int> &ids, int address, int length, bool fast);
    Servo *heard(int id);

    FakeLine &m_line;
};
