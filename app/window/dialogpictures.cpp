// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/window/dialogpictures.h"

#include "ui/backup/comparesource.h"
#include "ui/backup/restoredialog.h"
#include "ui/profile/profilefilebar.h"
#include "ui/table/consequencesdialog.h"

#include <QAction>
#include <QCheckBox>
#include <QDir>
#include <QFile>
#include <QPushButton>
#include <QSpinBox>

namespace dynascope {

namespace {

void setRegister(Backup &backup, QStringView name, std::int64_t raw)
{
    for (BackupRegister &one : backup.registers) {
        if (backup.fieldOf(one).name == name)
            one.raw = raw;
    }
}

} // namespace

DialogPictures::DialogPictures(Workshop &workshop)
    : m_workshop(workshop)
    , m_backups(workshop.session(), workshop.commands())
{
}

std::vector<DialogPictures::One> DialogPictures::all()
{
    const auto clicking = [this](const char *button) {
        return [this, button] {
            click(button);
            return m_open.data();
        };
    };
    const auto agreeing = [this] { return agreeToTorqueOff(); };
    return {{"moves", QSize(720, 620), {[this] { return openMoves(); }, clicking("numberButton"), agreeing}},
            {"profile",
             QSize(1000, 560),
             {[this] { return openProfile(); }, clicking("compareButton"), [this] { return m_open.data(); }}},
            {"profile-plan", QSize(1000, 560), {clicking("applyButton"), agreeing}},
            {"commission", QSize(720, 560), {[this] { return open("commissionAction", "commissionDialog"); }}},
            {"dashboard", QSize(960, 640), {[this] { return open("dashboardAction", "dashboardDialog"); }}},
            {"compare", QSize(880, 520), {[this] { return openCompare(); }, [this] { return m_open.data(); }}},
            {"journal",
             QSize(960, 520),
             {[this] { return writeSomething(); }, [this] { return open("journalAction", "journalDialog"); }}},
            {"reset", QSize(), {[this] { return open("factoryResetAction", "factoryResetDialog"); }}},
            {"restore", QSize(640, 520), {[this] { return openRestore(); }, agreeing}},
            {"consequences", QSize(), {[this] { return openConsequences(); }}}};
}

QDialog *DialogPictures::open(const char *action, const char *dialog)
{
    if (m_open)
        m_open->close();
    if (auto *found = m_workshop.window().findChild<QAction *>(QLatin1String(action)))
        found->trigger();
    m_open = m_workshop.window().findChild<QDialog *>(QLatin1String(dialog));
    return m_open;
}

void DialogPictures::click(const char *button)
{
    if (auto *found = m_open ? m_open->findChild<QPushButton *>(QLatin1String(button)) : nullptr)
        found->click();
}

Device *DialogPictures::joint(std::size_t which) const
{
    for (Device *device : m_workshop.session().devices()) {
        if (device->state() == Device::State::Present && which-- == 0)
            return device;
    }
    return nullptr;
}

QDialog *DialogPictures::openMoves()
{
    QDialog *dialog = open("moveManyAction", "moveDialog");
    if (auto *first = dialog ? dialog->findChild<QSpinBox *>(QStringLiteral("firstId")) : nullptr)
        first->setValue(2); // all up by one: a chain that begins at its end
    return dialog;
}

QDialog *DialogPictures::agreeToTorqueOff()
{
    if (auto *box = m_open ? m_open->findChild<QCheckBox *>(QStringLiteral("turnTorqueOff")) : nullptr)
        box->setChecked(true);
    return m_open;
}

/// The robot as it is, but for some settings of its first joints.
QString DialogPictures::writeProfile() const
{
    const QStringList names{QStringLiteral("base"), QStringLiteral("shoulder"), QStringLiteral("elbow")};
    QString yaml = QStringLiteral("profile: 1\nname: demo arm\njoints:\n");
    for (std::size_t i = 0; const Device *device = joint(i); ++i) {
        const auto at = static_cast<qsizetype>(i);
        const QString name = at < names.size() ? names[at] : QStringLiteral("joint %1").arg(i + 1);
        yaml += QStringLiteral("  - name: %1\n    model: %2\n    id: %3\n    baud: %4\n")
                    .arg(name, device->model())
                    .arg(device->id())
                    .arg(device->baudRate());
        if (at == 0)
            yaml += QStringLiteral("    registers:\n      Operating Mode: Extended position control\n"
                                   "      Position P Gain: 640\n");
        else if (at == 1)
            yaml += QStringLiteral("    registers:\n      Max Position Limit: 270 deg\n      Temperature Limit: 70\n");
    }
    // Where the folder is would be another path in each picture.
    QDir::setCurrent(m_folder.path());
    QFile file(QStringLiteral("demo-arm.yaml"));
    if (file.open(QIODevice::WriteOnly))
        file.write(yaml.toUtf8());
    return file.fileName();
}

QDialog *DialogPictures::openProfile()
{
    QDialog *dialog = open("profileAction", "profileView");
    if (auto *bar = dialog ? dialog->findChild<ProfileFileBar *>() : nullptr)
        emit bar->openRequested(writeProfile());
    return dialog;
}

/// So that there is something in the journal.
QDialog *DialogPictures::writeSomething()
{
    if (m_open)
        m_open->close();
    const auto writes = {std::tuple(0, u"Profile Velocity", 120), std::tuple(0, u"Position P Gain", 640),
                         std::tuple(1, u"LED", 1)};
    for (const auto &[which, name, raw] : writes) {
        Device *device = joint(static_cast<std::size_t>(which));
        const int field = device ? device->table().indexOf(name) : -1;
        if (field >= 0)
            m_workshop.commands().writeField(*device, field, raw);
    }
    return nullptr;
}

QDialog *DialogPictures::openCompare()
{
    QDialog *dialog = open("compareAction", "compareDialog");
    auto *with = dialog ? dialog->findChild<CompareSource *>(QStringLiteral("compareWith")) : nullptr;
    if (with && joint(1))
        with->setDevice(*joint(1));
    return nullptr; // once both are read
}

/// What the second joint holds, to be written to the first.
QDialog *DialogPictures::openRestore()
{
    if (m_open)
        m_open->close();
    if (!joint(1))
        return nullptr;
    m_backups.read(*joint(1), [this](const Result<Backup> &backup) {
        Device *device = joint(0);
        if (!backup || !device)
            return;
        Backup other = *backup;
        other.file = QStringLiteral("shoulder.yaml");
        for (const auto &[name, raw] : {std::pair("Max Position Limit", 3072), std::pair("PWM Limit", 600)})
            setRegister(other, QString::fromLatin1(name), raw);
        m_open = new RestoreDialog(*device, m_backups, other, {}, &m_workshop.window());
        m_open->setAttribute(Qt::WA_DeleteOnClose);
        m_open->show();
    });
    return nullptr;
}

QDialog *DialogPictures::openConsequences()
{
    if (m_open)
        m_open->close();
    Device *device = joint(0);
    const int mode = device ? device->table().indexOf(u"Operating Mode") : -1;
    if (mode < 0)
        return nullptr;
    const auto nothing = [](Device &, bool) {};
    m_open = new ConsequencesDialog({{device}, mode, 4, {}, [](Device &) {}, nothing}, &m_workshop.window());
    m_open->setAttribute(Qt::WA_DeleteOnClose);
    m_open->show();
    return m_open;
}

} // namespace dynascope
