// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/linefactory.h"

namespace dynascope {

/// Opens the lines of a recording: they are there, at the rate they had, and whatever is asked on them fails with
/// NotSupported, in words. So everything that shows devices works on them as on others.
class RecordedLines final : public LineFactory
{
public:
    bool knows(const QString &name) const override;
    bool isRecorded() const override { return true; }
    Result<std::unique_ptr<Line>> open(const QString &name, int baudRate) override;
};

} // namespace dynascope
