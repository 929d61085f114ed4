// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/fakefactory.h"

using namespace dynascope;

Result<std::unique_ptr<Line>> FakeFactory::open(const QString &name, int baudRate)
{
    if (!knows(name))
        return failure(ErrorKind::PortNotFound, QStringLiteral("there is no port %1").arg(name));
    auto line = std::make_unique<FakeLine>(baudRate);
    m_servos = std::make_unique<FakeServos>(*line);
    for (const int id : {1, 2, 3})
        m_servos->servos[id].registers[132] = static_cast<std::uint8_t>(id);
    if (m_prepare)
        m_prepare(*line, *m_servos);
    line->handler = [inner = line->handler, log = log, raw = line.get()](const Bytes &request) {
        log->push_back({raw->now(), raw->baudRate(), request});
        return inner(request);
    };
    return std::unique_ptr<Line>(std::move(line));
}
