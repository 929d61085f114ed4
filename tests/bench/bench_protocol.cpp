// SPDX-License-Identifier: GPL-3.0-or-later
// The packets of one read, made and taken apart, on both sides of the wire.
#include "core/protocol/parser.h"
#include "core/protocol/requests.h"

#include <benchmark/benchmark.h>

using namespace dynascope;

namespace {

void makeRequest(benchmark::State &state)
{
    for (auto _ : state)
        benchmark::DoNotOptimize(encode(readRequest({1, 132, 4}).packet));
}

void takeReplyApart(benchmark::State &state)
{
    const Bytes bytes = encode(StatusPacket{1, DeviceError::None, false, {0xA6, 0, 0, 0}});
    Parser parser;
    for (auto _ : state) {
        parser.feed(bytes);
        benchmark::DoNotOptimize(parser.next());
    }
}

/// Request made, taken apart by the servo, reply made, taken apart by the controller.
void wholeRead(benchmark::State &state)
{
    Parser servo;
    Parser controller;
    for (auto _ : state) {
        servo.feed(encode(readRequest({1, 132, 4}).packet));
        benchmark::DoNotOptimize(servo.next());
        controller.feed(encode(StatusPacket{1, DeviceError::None, false, {0xA6, 0, 0, 0}}));
        benchmark::DoNotOptimize(controller.next());
    }
}

} // namespace

BENCHMARK(makeRequest);
BENCHMARK(takeReplyApart);
BENCHMARK(wholeRead);
BENCHMARK_MAIN();
