// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/backup/comparesource.h"

#include "core/session/session.h"
#include "ui/common/filedialogs.h"

#include <QDir>
#include <QFileInfo>

namespace dynascope {

constexpr int FileItem = 1;

CompareSource::CompareSource(const Workbench &workbench, BackupCommands &commands, QWidget *parent)
    : QComboBox(parent)
    , m_workbench(workbench)
    , m_commands(commands)
{
    addItem(tr("Choose…"));
    addItem(tr("A backup's file…"));
    for (const Device *device : workbench.session.devices())
        addItem(tr("%1, ID %2").arg(device->displayName()).arg(device->id()), QVariant::fromValue(device->key()));
    setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon); // a file's name may be long
    setMinimumContentsLength(18);
    connect(this, &QComboBox::activated, this, &CompareSource::onActivated);
}

void CompareSource::onActivated(int index)
{
    if (index == FileItem) {
        setCurrentIndex(m_shown);
        return askWhatToOpen(this, tr("Compare"), {QStringLiteral("yaml")},
                             [here = QPointer<CompareSource>(this)](const QString &path) {
                                 if (here)
                                     here->setFile(path);
                             });
    }
    if (itemData(index).typeId() == QMetaType::QString)
        return setFile(itemData(index).toString());
    if (index <= 0) { // given up
        clear();
        emit chosen();
        return;
    }
    Device *device = m_workbench.session.device(itemData(index).value<DeviceKey>());
    if (device)
        return setDevice(*device);
    clear();
    emit failed(tr("That device is gone."));
}

void CompareSource::clear()
{
    m_device = nullptr;
    m_file.reset();
    m_shown = 0;
    setCurrentIndex(0);
}

void CompareSource::setDevice(Device &device)
{
    m_device = &device;
    m_file.reset();
    m_shown = findData(QVariant::fromValue(device.key()));
    setCurrentIndex(m_shown);
    connect(&device, &QObject::destroyed, this, &CompareSource::onGone);
    emit chosen();
}

void CompareSource::onGone()
{
    if (isChosen() || m_shown == 0) // it was another one
        return;
    clear();
    emit failed(tr("That device is gone."));
}

void CompareSource::setFile(const QString &path)
{
    auto backup = loadBackup(path, m_workbench.session.catalog());
    if (!backup) {
        clear();
        emit failed(backup.error().text);
        return;
    }
    m_device = nullptr;
    m_file = std::move(*backup);
    m_shown = findData(path);
    if (m_shown < 0) {
        m_shown = count();
        addItem(QFileInfo(path).fileName(), path);
        setItemData(m_shown, QDir::toNativeSeparators(path), Qt::ToolTipRole);
    }
    setCurrentIndex(m_shown);
    emit chosen();
}

void CompareSource::read(BackupCommands::Done done)
{
    if (m_file)
        return done(*m_file);
    m_commands.read(*m_device, std::move(done));
}

} // namespace dynascope
