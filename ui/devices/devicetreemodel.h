// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/session.h"

#include <QAbstractItemModel>
#include <QTimer>

namespace dynascope {

/// Line → baud rate → device, kept up to date with a Session. One column. A device that changes its ID or baud rate
/// moves; it doesn't go and come, so a selection stays with it.
class DeviceTreeModel : public QAbstractItemModel
{
    Q_OBJECT

public:
    enum class Kind { Line, Baud, Device };
    enum Role {
        KindRole = Qt::UserRole,
        SubtitleRole, ///< second line of a row
        IdRole,       ///< the device's ID; nothing for others
        AlertRole,    ///< names of the latched hardware errors, empty where none are
        DimmedRole,   ///< not reachable now: parked, silent, line closed
        TorqueRole,   ///< bool; nothing where it isn't known
        WorkingRole,  ///< of a baud row: the line works at it
    };

    explicit DeviceTreeModel(Session &session, QObject *parent = nullptr);
    ~DeviceTreeModel() override;

    Kind kind(const QModelIndex &index) const;
    LineSession *line(const QModelIndex &index) const; ///< of any row
    Device *device(const QModelIndex &index) const;    ///< nullptr for other rows
    int baudRate(const QModelIndex &index) const;      ///< 0 for a line's row
    QModelIndex indexOf(const Device *device) const;
    QModelIndex indexOf(const LineSession *line) const;

    QModelIndex index(int row, int column, const QModelIndex &parent = {}) const override;
    QModelIndex parent(const QModelIndex &child) const override;
    int rowCount(const QModelIndex &parent = {}) const override;
    int columnCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role) const override;

private:
    struct LineNode;
    struct BaudNode {
        LineNode *line = nullptr;
        int baudRate = 0;
        std::vector<Device *> devices;     ///< by ID
    };
    struct LineNode {
        LineSession *line = nullptr;
        std::vector<std::unique_ptr<BaudNode>> bauds; ///< by rate
    };

    void addLine(LineSession *line);
    void removeLine(LineSession *line);
    void addDevice(Device *device);
    void removeDevice(Device *device);
    void placeDevice(Device *device);
    void dropIfEmpty(BaudNode *baud);
    void touch(const QModelIndex &index);
    void touchLine(LineSession *line);

    LineNode *nodeOf(const LineSession *line) const;
    BaudNode *nodeOf(const Device *device) const;
    BaudNode *baudNode(LineNode *line, int baudRate); ///< made where there is none
    int rowOf(const LineNode *line) const;
    int rowOf(const BaudNode *baud) const;
    QModelIndex indexOf(BaudNode *baud) const;

    QVariant lineData(const LineNode &node, int role) const;
    QVariant baudData(const BaudNode &node, int role) const;
    QVariant deviceData(const Device &device, int role) const;

    Session &m_session;
    std::vector<std::unique_ptr<LineNode>> m_lines;
    QTimer m_ageTimer; ///< "last heard 3 min ago" grows older by itself
};

} // namespace dynascope
