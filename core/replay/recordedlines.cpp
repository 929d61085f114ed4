// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/replay/recordedlines.h"

#include <chrono>
#include <thread>

namespace dynascope {
namespace {

class RecordedLine final : public Line
{
public:
    RecordedLine(QString name, int baudRate) : m_name(std::move(name)), m_baudRate(std::max(1, baudRate)) { }

    QString name() const override { return m_name; }
    LineTime now() const override { return std::chrono::steady_clock::now().time_since_epoch(); }
    Result<void> write(ByteView) override { return refusal(); }
    Result<void> read(Bytes &, LineTime deadline) override
    {
        std::this_thread::sleep_until(std::chrono::steady_clock::time_point(deadline)); // as a silent wire
        return {};
    }
    void discardInput() override { }
    int baudRate() const override { return m_baudRate; }
    Result<void> setBaudRate(int) override { return refusal(); }
    bool canSetBaudRate() const override { return false; }
    LineTime hostAllowance() const override { return {}; }

private:
    static tl::unexpected<Error> refusal()
    {
        return failure(ErrorKind::NotSupported,
                       QStringLiteral("This is a recording: nothing can be asked of its devices, or told to them"));
    }

    QString m_name;
    int m_baudRate;
};

} // namespace

bool RecordedLines::knows(const QString &) const
{
    return true;
}

Result<std::unique_ptr<Line>> RecordedLines::open(const QString &name, int baudRate)
{
    return std::make_unique<RecordedLine>(name, baudRate);
}

} // namespace dynascope
