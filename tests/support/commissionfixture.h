// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/catalog.h"
#include "tests/support/sessionfixture.h"

#include <QTemporaryDir>

namespace dynascope::test {

/// A session on a line in virtual time, and servos that are plugged in and pulled out meanwhile. At first all are in, or none.
struct PluggedSession {
    PluggedSession(const Catalog &catalog, const QString &servos, bool areIn, Journal *journal = nullptr)
        : all(catalog, servos, journal)
        , plugged(std::make_unique<std::atomic<bool>[]>(all.factory.simulated.servos().size()))
        , now(all.factory.simulated.servos().size(), areIn)
    {
        for (std::size_t i = 0; i < now.size(); ++i) {
            plugged[i] = areIn;
            all.factory.simulated.servos()[i]->setPlugged(areIn);
        }
        all.factory.onPacket = [this](int, ByteView) { carryOut(); };
        all.line = &all.session.open(QStringLiteral("virtual"), 57600);
    }
    ~PluggedSession()
    {
        if (all.line)
            all.close();
    }
    void plug(std::size_t index, bool in = true) { plugged[index] = in; }
    LineSession &line() { return *all.line; }

    VirtualSession all;
    QTemporaryDir folder;

private:
    void carryOut() ///< bus thread
    {
        for (std::size_t i = 0; i < now.size(); ++i) {
            if (now[i] == plugged[i])
                continue;
            now[i] = plugged[i];
            all.factory.simulated.servos()[i]->setPlugged(now[i]);
        }
    }

    std::unique_ptr<std::atomic<bool>[]> plugged;
    std::vector<bool> now; ///< bus thread
};

} // namespace dynascope::test
