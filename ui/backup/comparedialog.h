// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/backup/comparesource.h"

#include <QDialog>

class QCheckBox;
class QLabel;
class QPushButton;
class QTreeView;

namespace dynascope {

class CompareModel;

/// Two of devices and backups' files beside each other. For present(), never exec().
class CompareDialog : public QDialog
{
    Q_OBJECT

public:
    /// `commands` outlives this. `device`, if there is one, is the first side to begin with.
    CompareDialog(Device *device, const Workbench &workbench, BackupCommands &commands, QWidget *window);

signals:
    /// These registers of the second side, whose file or device it is, to be restored to the first, a device.
    void restoreRequested(dynascope::DeviceKey device, const dynascope::Backup &from, const QStringList &only);

private:
    void makeView();
    void onChosen();
    void onFailed(const QString &why);
    void readSide(CompareSource &source, std::optional<Backup> &side);
    void showRows();
    void update();
    void say(const QString &text);
    void restoreSelected();
    QStringList selectedNames() const;

    CompareModel *m_model;
    QTreeView *m_view;
    CompareSource *m_of, *m_with; ///< here and there
    QCheckBox *m_onlyDifferences;
    QLabel *m_summary;
    QPushButton *m_restore;
    std::optional<Backup> m_here, m_there;
    int m_reads = 0; ///< the newest counts
};

} // namespace dynascope
