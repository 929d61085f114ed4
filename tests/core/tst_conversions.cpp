// SPDX-License-Identifier: GPL-3.0-or-later
// Every conversion that the library knows, forth and back: an editor that is opened and left unchanged writes nothing.
#include "core/table/catalog.h"
#include "core/table/units.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/testmain.h"

#include <algorithm>
#include <random>

using namespace dynascope;
using namespace dynascope::test;

namespace {

/// What a number of a register is, apart from its name and limits.
struct Kind {
    Field field; ///< bare, of this size and sign
    EffectiveField now;
    int resolution = 0;

    auto key() const
    {
        const bool turning = now.unit == Unit::Pulse || now.unit == Unit::PulsePerSec
            || now.unit == Unit::PulsePerMs; // nothing else knows what a turn is
        return std::tuple(field.size, field.isSigned, now.unit, now.scale, turning ? resolution : 0,
                          turning ? now.turns : 1.0, now.directionBit, now.torqueConstant);
    }
    QString text() const
    {
        return QStringLiteral("%1 %2 × %3, %4 bytes%5%6, %7 a turn")
            .arg(field.name, tableUnit(now.unit))
            .arg(now.scale)
            .arg(field.size)
            .arg(field.isSigned ? QStringLiteral(", signed") : QString(),
                 now.directionBit >= 0 ? QStringLiteral(", bit %1 is the direction").arg(now.directionBit) : QString())
            .arg(resolution * now.turns);
    }
};

/// All that differ, of every register of every model and firmware, and of what they become.
std::vector<Kind> kinds()
{
    const Catalog catalog = builtInCatalog();
    std::vector<Kind> all;
    const auto add = [&](const Kind &kind) {
        const auto same = [&](const Kind &other) { return other.key() == kind.key(); };
        if (kind.now.unit != Unit::None && std::none_of(all.begin(), all.end(), same))
            all.push_back(kind);
    };
    for (const Catalog::ModelInfo &info : catalog.models()) {
        const ControlTablePtr table = catalog.find(info.modelNumber, 255);
        for (const Field &field : table->fields()) {
            Kind kind;
            kind.field.name = info.model + u' ' + field.name;
            kind.field.size = field.size;
            kind.field.isSigned = field.isSigned;
            kind.resolution = table->resolution();
            kind.now = effective(field, {});
            kind.now.minimum = kind.now.maximum = std::nullopt;
            add(kind);
            for (const Alternate &alternate : field.alternates) {
                kind.now.unit = alternate.unit;
                kind.now.scale = alternate.scale;
                kind.now.directionBit = alternate.directionBit;
                add(kind);
            }
        }
    }
    return all;
}

/// All of one or two bytes; of four the ends, the powers of two with their neighbours, and as many at random.
std::vector<std::int64_t> rawValues(const Field &field, int random)
{
    const std::int64_t low = smallestRaw(field), high = largestRaw(field);
    std::vector<std::int64_t> values;
    if (field.size < 4) {
        for (std::int64_t raw = low; raw <= high; ++raw)
            values.push_back(raw);
        return values;
    }
    for (int bit = 0; bit <= 32; ++bit) {
        const std::int64_t power = std::int64_t(1) << bit;
        for (const std::int64_t raw : {power - 1, power, power + 1}) {
            values.push_back(raw);
            values.push_back(-raw);
        }
    }
    values.insert(values.end(), {low, low + 1, high - 1, high});
    std::mt19937_64 generator(1);
    std::uniform_int_distribution<std::int64_t> any(low, high);
    for (int i = 0; i < random; ++i)
        values.push_back(any(generator));
    std::erase_if(values, [&](std::int64_t raw) { return raw < low || raw > high; });
    return values;
}

/// Those that change how this is shown.
std::vector<UnitPreferences> preferences(const Kind &kind)
{
    std::vector<UnitPreferences> all{{}};
    if (kind.now.unit == Unit::Pulse || kind.now.unit == Unit::Degree)
        all.insert(all.end(), {AngleUnit::Radians, AngleUnit::Turns, AngleUnit::Pulses});
    UnitPreferences other;
    other.torque = true;
    if (kind.now.torqueConstant > 0)
        all.push_back(other);
    other.raw = true;
    all.push_back(other);
    return all;
}

} // namespace

class TestConversions : public QObject
{
    Q_OBJECT

private slots:
    void thereAreManyKinds()
    {
        const std::vector<Kind> all = kinds();
        QVERIFY2(all.size() > 50, qPrintable(QString::number(all.size())));
        const auto has = [&](auto condition) { return std::any_of(all.begin(), all.end(), condition); };
        QVERIFY(has([](const Kind &kind) { return kind.now.directionBit == 10; }));
        QVERIFY(has([](const Kind &kind) { return kind.now.unit == Unit::Degree; }));
        QVERIFY(has([](const Kind &kind) { return kind.now.turns != 1.0; }));
        QVERIFY(has([](const Kind &kind) { return kind.now.torqueConstant > 0; }));
    }

    void rawToPhysicalAndBack()
    {
        for (const Kind &kind : kinds()) {
            for (const UnitPreferences &units : preferences(kind)) {
                const int random = units == UnitPreferences() ? 100'000 : 5'000;
                for (const std::int64_t raw : rawValues(kind.field, random)) {
                    const double value = physical(kind.now, kind.resolution, raw, units).value;
                    if (rawFromPhysical(kind.now, kind.resolution, value, units) != raw)
                        QFAIL(qPrintable(QStringLiteral("%1: %2").arg(kind.text()).arg(raw)));
                }
            }
        }
    }

    void whatIsShownIsWhatItWas()
    {
        for (const Kind &kind : kinds()) {
            for (const UnitPreferences &units : preferences(kind)) {
                // Every text costs some microseconds: all of them as they are shown at first, else one in 17.
                const std::vector<std::int64_t> values = rawValues(kind.field, 2'000);
                const std::size_t step = units == UnitPreferences() ? 1 : 17;
                for (std::size_t i = 0; i < values.size(); i += step) {
                    const std::int64_t raw = values[i];
                    // More than the other bits of a direction can say is no value of such a register.
                    const std::int64_t most = (std::int64_t(2) << std::max(0, kind.now.directionBit)) - 1;
                    if (kind.now.directionBit >= 0 && raw > most)
                        break;
                    const QString text = valueText(kind.field, kind.now, kind.resolution, raw, units);
                    const auto back = parseValue(kind.field, kind.now, kind.resolution, text, units);
                    if (!back || *back != raw)
                        QFAIL(qPrintable(QStringLiteral("%1: %2 is shown as %3").arg(kind.text()).arg(raw).arg(text)));
                }
            }
        }
    }
};

DYNASCOPE_CORE_TEST(TestConversions)
#include "tst_conversions.moc"
