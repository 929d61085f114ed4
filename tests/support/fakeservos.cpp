// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/fakeservos.h"

#include "tests/support/oracle.h"

using namespace dynascope;

namespace {

constexpr std::size_t ParametersAt = 8;

Bytes piece(const Bytes &from, int at, int length)
{
    return {from.begin() + at, from.begin() + at + length};
}

} // namespace

FakeServos::Servo *FakeServos::heard(int id)
{
    const auto servo = servos.find(id);
    if (servo == servos.end() || servo->second.deaf || servo->second.baudRate != m_line.baudRate())
        return nullptr;
    return &servo->second;
}

FakeLine::Answer FakeServos::answer(const Bytes &request)
{
    const int id = request[4];
    const int code = request[7];
    const Bytes parameters(request.begin() + ParametersAt, request.end() - 2);
    const auto reply = [&](std::uint8_t from, const Bytes &data) {
        return FakeLine::Answer{{FakeLine::DefaultDelay, oracle::status(from, 0, data)}};
    };
    const auto word = [&](std::size_t at) { return parameters[at] + 256 * parameters[at + 1]; };
    if (code == 1 && id == 254) {
        FakeLine::Answer all;
        for (const auto &[each, servo] : servos) {
            if (heard(each) && !servo.silent)
                all.push_back({std::chrono::milliseconds(3 * each),
                    oracle::status(static_cast<std::uint8_t>(each), 0, {1, 4, 45})});
        }
        return all;
    }
    if (code == 0x82 || code == 0x8A)
        return chain({parameters.begin() + 4, parameters.end()}, word(0), word(2), code == 0x8A);
    if (code == 0x83) {
        const int length = word(2);
        for (std::size_t at = 4; at < parameters.size(); at += static_cast<std::size_t>(length) + 1) {
            if (Servo *servo = heard(parameters[at]))
                std::copy_n(parameters.begin() + static_cast<int>(at) + 1, length, servo->registers.begin() + word(0));
        }
        return {};
    }
    Servo *servo = heard(id);
    if (!servo)
        return {};
    Bytes data;
    if (code == 1)
        data = {1, 4, 45};
    else if (code == 2)
        data = piece(servo->registers, word(0), word(2));
    else if (code == 3)
        std::copy(parameters.begin() + 2, parameters.end(), servo->registers.begin() + word(0));
    const bool isSilent = servo->silent || (servo->onlyPing && code != 1);
    return isSilent ? FakeLine::Answer{} : reply(static_cast<std::uint8_t>(id), data);
}

/// Each waits to hear the one before it; the first that is missing silences the rest.
FakeLine::Answer FakeServos::chain(const std::vector<int> &ids, int address, int length, bool fast)
{
    FakeLine::Answer answers;
    LineTime at = FakeLine::DefaultDelay;
    const std::size_t total = 1 + ids.size() * (static_cast<std::size_t>(length) + 4);
    Bytes joined{
        0xFF, 0xFF, 0xFD, 0x00, 0xFE, static_cast<std::uint8_t>(total), static_cast<std::uint8_t>(total >> 8), 0x55};
    bool any = false;
    for (const int id : ids) {
        const Servo *servo = heard(id);
        if (!servo || servo->silent || servo->onlyPing || (fast && !servo->knowsFast))
            break;
        any = true;
        const Bytes data = piece(servo->registers, address, length);
        if (fast) {
            joined.push_back(0);
            joined.push_back(static_cast<std::uint8_t>(id));
            joined.insert(joined.end(), data.begin(), data.end());
            const std::uint16_t crc = oracle::crc(joined);
            joined.push_back(static_cast<std::uint8_t>(crc));
            joined.push_back(static_cast<std::uint8_t>(crc >> 8));
            continue;
        }
        const Bytes packet = oracle::status(static_cast<std::uint8_t>(id), 0, data);
        answers.push_back({at, packet});
        at += static_cast<LineTime::rep>(packet.size()) * m_line.byteTime() + FakeLine::DefaultDelay;
    }
    if (fast && any)
        answers.push_back({at, joined});
    return answers;
}
