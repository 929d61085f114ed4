// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/consequences.h"
#include "core/session/device.h"

#include <QDialog>
#include <QPointer>

#include <functional>

class QCheckBox;
class QGridLayout;
class QLabel;
class QPushButton;
class QVBoxLayout;

namespace dynascope {

/// A write about which a person should know more first, and the ways it can be done.
struct AskedWrite {
    std::vector<Device *> devices; ///< of one model
    int field = -1;
    std::int64_t raw = 0;
    UnitPreferences units = {};
    std::function<void(Device &)> writeOnly;                   ///< as any write
    std::function<void(Device &, bool torqueOn)> writeSafely; ///< nothing: there is no safe way
};

/// Says what a write brings besides, lists the steps of the safe way, and lets a person choose. Torque comes on again
/// only where its box is ticked, or where torque on is what was asked for. Goes with its devices. For present().
class ConsequencesDialog : public QDialog
{
    Q_OBJECT

public:
    ConsequencesDialog(AskedWrite write, QWidget *parent);

private:
    const Field &field() const;
    void addHeading(QVBoxLayout &layout);
    void addConsequences(QVBoxLayout &layout);
    void addSteps(QVBoxLayout &layout);
    void addButtons(QVBoxLayout &layout);
    QStringList steps() const;
    void check();
    void carryOut(bool safely);

    AskedWrite m_write;
    const ControlTablePtr m_table;
    bool m_isTorque = false; ///< torque on is what was asked for
    bool m_hadTorque = false, m_resets = false, m_changesProtocol = false;
    std::vector<QPointer<Device>> m_devices;
    QCheckBox *m_torqueBack = nullptr;
    QPushButton *m_safe = nullptr, *m_only = nullptr;
};

/// Of this device as it is shown.
std::vector<Consequence> consequencesOf(const Device &device, int field, std::int64_t raw,
                                        const UnitPreferences &units = {});
/// Is torque all that keeps the field from being written?
bool isLockedByTorqueAlone(const Device &device, int field);

/// Who of them would jump or run when torque comes on, a paragraph for each; empty: nobody.
QString jumpsText(const std::vector<Device *> &devices, const UnitPreferences &units);

/// Shows the dialog, or brings the one about the same to the front. Returns at once.
void askAboutConsequences(AskedWrite write, QWidget *parent);

} // namespace dynascope
