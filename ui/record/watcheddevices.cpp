// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/record/watcheddevices.h"

#include "core/record/recordedvalue.h"

#include <QFileInfo>

#include <algorithm>

namespace dynascope {
namespace {

/// As far as it was read.
std::vector<RecordedSpan> imageOf(const Device &device)
{
    std::vector<RecordedSpan> image;
    const std::span<const Field> fields = device.table().fields();
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const auto raw = device.value(static_cast<int>(i)).raw;
        if (!raw)
            continue;
        const Bytes bytes = bytesFromRaw(fields[i], *raw);
        if (image.empty() || image.back().address + static_cast<int>(image.back().data.size()) != fields[i].address)
            image.push_back({fields[i].address, {}});
        image.back().data.insert(image.back().data.end(), bytes.begin(), bytes.end());
    }
    return image;
}

} // namespace

WatchedDevices::WatchedDevices(Session &session, const Monitor &monitor, QObject *parent)
    : QObject(parent)
    , m_session(session)
    , m_monitor(monitor)
{
    connect(&monitor, &Monitor::watchesChanged, this, qOverload<>(&WatchedDevices::update));
    connect(&session, &Session::deviceAdded, this, &WatchedDevices::follow);
    for (Device *device : session.devices())
        follow(device);
}

void WatchedDevices::follow(Device *device)
{
    connect(device, &Device::attributesChanged, this, [this, device] { update(*device); });
    // A unit that depends on another register changes before the first value of the new meaning is handed on.
    connect(device, &Device::fieldsChanged, this, [this, device](int first, int last) {
        const auto deciding = m_deciding.find(device->key());
        if (deciding == m_deciding.end())
            return;
        const auto changed = deciding->second.lower_bound(first);
        if (changed != deciding->second.end() && *changed <= last)
            update(*device);
    });
    update(*device);
}

bool WatchedDevices::isEmpty() const
{
    return std::ranges::all_of(m_devices, [](const RecordedDevice &device) { return device.fields.empty(); });
}

void WatchedDevices::update()
{
    for (const Device *device : m_session.devices())
        update(*device);
}

void WatchedDevices::update(const Device &device)
{
    RecordedDevice present = describe(device);
    const auto known = std::ranges::find(m_devices, present.key, &RecordedDevice::key);
    if (known == m_devices.end()) {
        if (present.fields.empty())
            return;
        present.image = imageOf(device);
        m_devices.push_back(present);
    } else {
        present.image = known->image;
        if (present == *known)
            return;
        present.image = imageOf(device);
        *known = present;
    }
    emit changed(present);
}

void WatchedDevices::takeImage(const Device &device)
{
    const auto known = std::ranges::find(m_devices, device.key(), &RecordedDevice::key);
    if (known == m_devices.end())
        return;
    std::vector<RecordedSpan> image = imageOf(device);
    if (image == known->image)
        return;
    known->image = std::move(image);
    emit changed(RecordedDevice(*known));
}

bool WatchedDevices::isImageWhole(const Device &device)
{
    const int count = static_cast<int>(device.table().fields().size());
    for (int i = 0; i < count; ++i) {
        if (!device.value(i).raw)
            return false;
    }
    return true;
}

RecordedDevice WatchedDevices::describe(const Device &device)
{
    RecordedDevice recorded;
    recorded.key = device.key();
    recorded.label = labelFor(device);
    recorded.line = device.line() ? device.line()->name() : QString();
    recorded.id = device.id();
    recorded.baudRate = device.baudRate();
    recorded.model = device.model();
    recorded.modelNumber = device.modelNumber();
    recorded.firmware = device.firmware();
    const ControlTable &table = device.table();
    std::set<int> &deciding = m_deciding[device.key()];
    deciding.clear();
    const std::set<Watch> &watches = m_monitor.watches();
    for (auto at = watches.lower_bound({device.key(), 0}); at != watches.end() && at->device == device.key(); ++at) {
        const Field &field = table.fields()[static_cast<std::size_t>(at->field)];
        const EffectiveField units = effective(field, [&](QStringView name) {
            deciding.insert(table.indexOf(name));
            return device.raw(name);
        });
        recorded.fields.push_back(recordedField(field, units, table.resolution()));
    }
    std::ranges::sort(recorded.fields, {}, &RecordedField::address);
    return recorded;
}

/// Its nickname, or "ID 3"; where another one is called so, with what tells them apart.
QString WatchedDevices::labelFor(const Device &device) const
{
    const auto isTaken = [&](const QString &label) {
        return std::ranges::any_of(m_devices, [&](const RecordedDevice &other) {
            return other.key != device.key() && other.label == label;
        });
    };
    QString label = device.nickname().isEmpty() ? QStringLiteral("ID %1").arg(device.id()) : device.nickname();
    if (isTaken(label) && device.line())
        label += u' ' + QFileInfo(device.line()->name()).fileName();
    const QString shared = label;
    for (int number = 2; isTaken(label); ++number)
        label = QStringLiteral("%1 (%2)").arg(shared).arg(number);
    return label;
}

} // namespace dynascope
