// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/quality_values.h"

#include <QString>

#include <array>
#include <optional>
#include <utility>

/// What can be wrong with an answer, in words, and how bad that is. Pure.
namespace dynascope {

/// Every bad answer is exactly one of these.
enum class AnswerFault { Missing, CutOff, Damaged, WrongLength, Late };
inline constexpr std::array AllAnswerFaults{AnswerFault::Missing, AnswerFault::CutOff, AnswerFault::Damaged,
    AnswerFault::WrongLength, AnswerFault::Late};

quint64 countOf(const DeviceQuality &quality, AnswerFault fault);
/// The one seen most; nothing where all answers were good.
std::optional<AnswerFault> mainFault(const DeviceQuality &quality);

QString faultName(AnswerFault fault);    ///< "Timeouts", as a column is headed
QString faultMeaning(AnswerFault fault); ///< one sentence: what was seen
QString usualCauses(AnswerFault fault);  ///< one sentence: what it usually comes from

/// From 0.1 % of bad answers on a cable is poor, from 1 % on it is bad. Two bad answers may be an accident.
enum class Verdict { Unknown, Good, Poor, Bad };
Verdict verdictOn(const DeviceQuality &quality);
/// To sort by: the verdict, then the share of bad answers in the steps in which it is shown, 0.01 %. So one bad answer of
/// twenty doesn't stand above a bad cable, and what looks alike keeps its order.
std::pair<Verdict, long long> badness(const DeviceQuality &quality);

} // namespace dynascope
