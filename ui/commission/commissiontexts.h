// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/commissioning/commissioning.h"

namespace dynascope {

/// What a person is to do now, or what became of it all: the one big sentence.
QString commissionSentence(const Commissioning &commissioning);
/// What is looked for, or what was found: a line below it.
QString commissionDetail(const Commissioning &commissioning, const Catalog &catalog);
/// Who was there before and is left alone; empty: nobody.
QString bystanderText(const Commissioning &commissioning, const Catalog &catalog);

/// The list of labels on paper, A4. BadFile.
Result<void> saveLabelsPdf(const CommissionList &list, const Catalog &catalog, const QString &title,
                           const QString &path);
Result<void> saveLabelsCsv(const CommissionList &list, const Catalog &catalog, const QString &path);

} // namespace dynascope
