// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/devices/devicetreemodel.h"

#include <algorithm>
#include <array>
#include <chrono>

// What the rows say is in devicetreetexts.cpp.
namespace dynascope {

namespace {

using namespace std::chrono_literals;

constexpr auto AgeInterval = 10s;

std::array<int, 3> shownFields(const Device &device)
{
    const ControlTable &table = device.table();
    return {table.indexOf(u"Torque Enable"), table.indexOf(u"Hardware Error Status"), table.indexOf(u"LED")};
}

bool byId(const Device *one, const Device *other)
{
    return one->id() < other->id();
}

} // namespace

DeviceTreeModel::DeviceTreeModel(Session &session, QObject *parent)
    : QAbstractItemModel(parent)
    , m_session(session)
{
    connect(&session, &Session::lineAdded, this, &DeviceTreeModel::addLine);
    connect(&session, &Session::lineAboutToBeRemoved, this, &DeviceTreeModel::removeLine);
    connect(&session, &Session::deviceAdded, this, &DeviceTreeModel::addDevice);
    connect(&session, &Session::deviceAboutToBeRemoved, this, &DeviceTreeModel::removeDevice);
    for (const auto &line : session.lines())
        addLine(line.get());
    connect(&m_ageTimer, &QTimer::timeout, this, [this] {
        for (const auto &node : m_lines)
            touchLine(node->line);
    });
    m_ageTimer.start(AgeInterval);
}

DeviceTreeModel::~DeviceTreeModel() = default;

void DeviceTreeModel::addLine(LineSession *line)
{
    const int row = static_cast<int>(m_lines.size());
    beginInsertRows({}, row, row);
    m_lines.push_back(std::make_unique<LineNode>());
    m_lines.back()->line = line;
    endInsertRows();
    connect(line, &LineSession::stateChanged, this, [this, line] { touchLine(line); });
    connect(line, &LineSession::deviceChanged, this, &DeviceTreeModel::placeDevice);
    for (const auto &device : line->devices())
        addDevice(device.get());
}

void DeviceTreeModel::removeLine(LineSession *line)
{
    LineNode *node = nodeOf(line);
    if (!node)
        return;
    line->disconnect(this);
    const int row = rowOf(node);
    beginRemoveRows({}, row, row);
    m_lines.erase(m_lines.begin() + row);
    endRemoveRows();
}

void DeviceTreeModel::addDevice(Device *device)
{
    LineNode *line = nodeOf(device->line());
    if (!line || nodeOf(device))
        return;
    BaudNode *baud = baudNode(line, device->baudRate());
    const auto at = std::ranges::lower_bound(baud->devices, device, byId);
    const auto row = static_cast<int>(at - baud->devices.begin());
    beginInsertRows(indexOf(baud), row, row);
    baud->devices.insert(at, device);
    endInsertRows();
    // A thousand times a second for what is plotted: only what the row shows counts.
    connect(device, &Device::fieldsChanged, this, [this, device, shown = shownFields(*device)](int first, int last) {
        if (std::ranges::any_of(shown, [first, last](int field) { return field >= first && field <= last; }))
            touch(indexOf(device));
    });
}

void DeviceTreeModel::removeDevice(Device *device)
{
    BaudNode *baud = nodeOf(device);
    if (!baud)
        return;
    device->disconnect(this);
    const auto row = static_cast<int>(std::ranges::find(baud->devices, device) - baud->devices.begin());
    beginRemoveRows(indexOf(baud), row, row);
    baud->devices.erase(baud->devices.begin() + row);
    endRemoveRows();
    dropIfEmpty(baud);
}

void DeviceTreeModel::placeDevice(Device *device)
{
    BaudNode *from = nodeOf(device);
    if (!from)
        return;
    BaudNode *to = baudNode(from->line, device->baudRate());
    const auto row = static_cast<int>(std::ranges::find(from->devices, device) - from->devices.begin());
    // Where it belongs among those there, itself left out.
    int target = 0;
    for (const Device *other : to->devices) {
        if (other != device && byId(other, device))
            ++target;
    }
    if (from != to || target != row) {
        // Qt counts the destination before the move: below itself there is one row more.
        const int destination = from == to && target > row ? target + 1 : target;
        beginMoveRows(indexOf(from), row, row, indexOf(to), destination);
        from->devices.erase(from->devices.begin() + row);
        to->devices.insert(to->devices.begin() + target, device);
        endMoveRows();
    }
    if (from != to)
        dropIfEmpty(from);
    touch(indexOf(device));
}

void DeviceTreeModel::dropIfEmpty(BaudNode *baud)
{
    if (!baud->devices.empty())
        return;
    const int row = rowOf(baud);
    LineNode *line = baud->line;
    beginRemoveRows(indexOf(line->line), row, row);
    line->bauds.erase(line->bauds.begin() + row);
    endRemoveRows();
}

void DeviceTreeModel::touch(const QModelIndex &index)
{
    emit dataChanged(index, index);
}

void DeviceTreeModel::touchLine(LineSession *line)
{
    LineNode *node = nodeOf(line);
    if (!node)
        return;
    const QModelIndex top = indexOf(line);
    touch(top);
    const auto bauds = static_cast<int>(node->bauds.size());
    if (bauds == 0)
        return;
    emit dataChanged(index(0, 0, top), index(bauds - 1, 0, top));
    for (const auto &baud : node->bauds) {
        const QModelIndex parent = indexOf(baud.get());
        emit dataChanged(index(0, 0, parent), index(rowCount(parent) - 1, 0, parent));
    }
}

DeviceTreeModel::LineNode *DeviceTreeModel::nodeOf(const LineSession *line) const
{
    const auto at = std::ranges::find_if(m_lines, [line](const auto &node) { return node->line == line; });
    return at == m_lines.end() ? nullptr : at->get();
}

DeviceTreeModel::BaudNode *DeviceTreeModel::nodeOf(const Device *device) const
{
    // By identity: its attributes may be ahead of where it stands here.
    const LineNode *line = nodeOf(device->line());
    if (!line)
        return nullptr;
    for (const auto &baud : line->bauds) {
        if (std::ranges::find(baud->devices, device) != baud->devices.end())
            return baud.get();
    }
    return nullptr;
}

DeviceTreeModel::BaudNode *DeviceTreeModel::baudNode(LineNode *line, int baudRate)
{
    const auto at =
        std::ranges::find_if(line->bauds, [baudRate](const auto &node) { return node->baudRate >= baudRate; });
    if (at != line->bauds.end() && (*at)->baudRate == baudRate)
        return at->get();
    const auto row = static_cast<int>(at - line->bauds.begin());
    beginInsertRows(indexOf(line->line), row, row);
    auto node = std::make_unique<BaudNode>();
    node->line = line;
    node->baudRate = baudRate;
    BaudNode *made = node.get();
    line->bauds.insert(at, std::move(node));
    endInsertRows();
    return made;
}

int DeviceTreeModel::rowOf(const LineNode *line) const
{
    const auto at = std::ranges::find_if(m_lines, [line](const auto &node) { return node.get() == line; });
    return static_cast<int>(at - m_lines.begin());
}

int DeviceTreeModel::rowOf(const BaudNode *baud) const
{
    const auto &bauds = baud->line->bauds;
    const auto at = std::ranges::find_if(bauds, [baud](const auto &node) { return node.get() == baud; });
    return static_cast<int>(at - bauds.begin());
}

QModelIndex DeviceTreeModel::indexOf(const LineSession *line) const
{
    const LineNode *node = nodeOf(line);
    return node ? createIndex(rowOf(node), 0, nullptr) : QModelIndex();
}

QModelIndex DeviceTreeModel::indexOf(BaudNode *baud) const
{
    return createIndex(rowOf(baud), 0, baud->line);
}

QModelIndex DeviceTreeModel::indexOf(const Device *device) const
{
    BaudNode *baud = device ? nodeOf(device) : nullptr;
    if (!baud)
        return {};
    const auto at = std::ranges::find(baud->devices, device);
    return createIndex(static_cast<int>(at - baud->devices.begin()), 0, baud);
}

// An index points to the node above its row: nothing for a line, the LineNode for a baud rate, the BaudNode for a
// device.

DeviceTreeModel::Kind DeviceTreeModel::kind(const QModelIndex &index) const
{
    if (!index.internalPointer())
        return Kind::Line;
    const bool isBaud = std::ranges::any_of(
        m_lines, [&index](const auto &node) { return node.get() == index.internalPointer(); });
    return isBaud ? Kind::Baud : Kind::Device;
}

LineSession *DeviceTreeModel::line(const QModelIndex &index) const
{
    if (!index.isValid())
        return nullptr;
    switch (kind(index)) {
    case Kind::Line: return m_lines[static_cast<std::size_t>(index.row())]->line;
    case Kind::Baud: return static_cast<LineNode *>(index.internalPointer())->line;
    case Kind::Device: break;
    }
    return static_cast<BaudNode *>(index.internalPointer())->line->line;
}

Device *DeviceTreeModel::device(const QModelIndex &index) const
{
    if (!index.isValid() || kind(index) != Kind::Device)
        return nullptr;
    return static_cast<BaudNode *>(index.internalPointer())->devices[static_cast<std::size_t>(index.row())];
}

int DeviceTreeModel::baudRate(const QModelIndex &index) const
{
    if (!index.isValid() || kind(index) == Kind::Line)
        return 0;
    if (kind(index) == Kind::Device)
        return static_cast<BaudNode *>(index.internalPointer())->baudRate;
    return static_cast<LineNode *>(index.internalPointer())->bauds[static_cast<std::size_t>(index.row())]->baudRate;
}

QModelIndex DeviceTreeModel::index(int row, int column, const QModelIndex &parent) const
{
    if (row < 0 || column != 0 || row >= rowCount(parent))
        return {};
    if (!parent.isValid())
        return createIndex(row, 0, nullptr);
    if (kind(parent) == Kind::Line)
        return createIndex(row, 0, m_lines[static_cast<std::size_t>(parent.row())].get());
    auto *line = static_cast<LineNode *>(parent.internalPointer());
    return createIndex(row, 0, line->bauds[static_cast<std::size_t>(parent.row())].get());
}

QModelIndex DeviceTreeModel::parent(const QModelIndex &child) const
{
    if (!child.isValid())
        return {};
    switch (kind(child)) {
    case Kind::Line: return {};
    case Kind::Baud: return createIndex(rowOf(static_cast<LineNode *>(child.internalPointer())), 0, nullptr);
    case Kind::Device: break;
    }
    return indexOf(static_cast<BaudNode *>(child.internalPointer()));
}

int DeviceTreeModel::rowCount(const QModelIndex &parent) const
{
    if (!parent.isValid())
        return static_cast<int>(m_lines.size());
    if (parent.column() != 0)
        return 0;
    switch (kind(parent)) {
    case Kind::Line: return static_cast<int>(m_lines[static_cast<std::size_t>(parent.row())]->bauds.size());
    case Kind::Baud: {
        const auto *line = static_cast<LineNode *>(parent.internalPointer());
        return static_cast<int>(line->bauds[static_cast<std::size_t>(parent.row())]->devices.size());
    }
    case Kind::Device: break;
    }
    return 0;
}

int DeviceTreeModel::columnCount(const QModelIndex &) const
{
    return 1;
}

QVariant DeviceTreeModel::data(const QModelIndex &index, int role) const
{
    if (!checkIndex(index, CheckIndexOption::IndexIsValid))
        return {};
    if (role == KindRole)
        return static_cast<int>(kind(index));
    switch (kind(index)) {
    case Kind::Line: return lineData(*m_lines[static_cast<std::size_t>(index.row())], role);
    case Kind::Baud: {
        const auto *line = static_cast<LineNode *>(index.internalPointer());
        return baudData(*line->bauds[static_cast<std::size_t>(index.row())], role);
    }
    case Kind::Device: break;
    }
    return deviceData(*device(index), role);
}

} // namespace dynascope
