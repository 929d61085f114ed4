// SPDX-License-Identifier: GPL-3.0-or-later
// Any text as a profile: refused with a sentence that says where, or saving what its joints hold into it leaves a text
// that is read again, means that, and is left alone by the next save. A byte that the registers are made of, then the text.
#include "core/session/profile/profilesave.h"
#include "core/session/profile/profilevalues.h"
#include "tests/fuzz/fuzzinput.h"

using namespace dynascope;
using fuzz::must;

namespace {

const Catalog &catalog()
{
    static const Catalog all = Catalog::builtIn().value();
    return all;
}

/// As the factory had it, but for every few registers, which hold another value that they may have.
SavedDevice deviceOf(const ProfileJoint &joint, std::uint8_t seed)
{
    SavedDevice device;
    device.found.id = static_cast<std::uint8_t>(joint.id);
    device.found.baudRate = joint.baudRate;
    device.found.modelNumber = static_cast<std::uint16_t>(joint.modelNumber);
    device.found.firmware = static_cast<std::uint8_t>(std::max(0, joint.firmware));
    const ControlTablePtr table = catalog().find(joint.modelNumber, device.found.firmware);
    for (const Field &field : table->fields()) {
        const bool isOther = seed != 0 && field.address % seed == 0;
        const std::int64_t raw = isOther ? field.maximum.number.value_or(1) : field.initial.value_or(0);
        device.image.take(field.address, bytesFromRaw(field, raw));
    }
    return device;
}

void save(const Profile &profile, const QByteArray &text, std::uint8_t seed)
{
    constexpr std::size_t Most = 8;
    std::vector<SavedDevice> devices;
    for (const ProfileJoint &joint : profile.joints) {
        if (devices.size() < Most)
            devices.push_back(deviceOf(joint, seed));
    }
    const auto saved = saveProfile(text, QStringLiteral("f"), devices, catalog());
    if (!saved)
        std::fprintf(stderr, "%s\n", qPrintable(saved.error().text));
    must(saved.has_value(), "what was read can be saved into");
    must(saved->isChanged() || saved->text == text, "where nothing changes the text is the same");
    const auto again = saveProfile(saved->text, QStringLiteral("f"), devices, catalog());
    must(again && !again->isChanged(), "a second save changes nothing");
    must(again->text == saved->text, "a second save leaves every byte");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    if (size == 0)
        return 0;
    const QByteArray text(reinterpret_cast<const char *>(data) + 1, static_cast<qsizetype>(size - 1));
    const auto profile = profileFromYaml(text, QStringLiteral("f"), catalog());
    if (profile)
        save(*profile, text, data[0]);
    else
        must(profile.error().text.startsWith(QStringLiteral("f:")), "a refusal says where");
    return 0;
}
