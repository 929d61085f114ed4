// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/backup/backupactions.h"
#include "ui/backup/comparemodel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMainWindow>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTreeView>

using namespace dynascope;
using namespace Qt::StringLiterals;

/// Backing up, comparing and restoring by clicks and keys.
class TestBackups : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_bench = std::make_unique<test::WorkbenchFixture>();
        LineSession &line = m_bench->session.open(u"sim"_s, 1000000);
        QTRY_COMPARE(line.state(), BusThread::State::Open);
        m_bench->scanner.start(line, {{57600, 1000000}, 0, 252});
        QTRY_VERIFY(!m_bench->scanner.isRunning());
        m_device = m_bench->device(1, 1000000);
        QVERIFY(m_device);
        m_window = std::make_unique<QMainWindow>();
        m_window->resize(900, 600);
        m_window->show();
        m_actions = std::make_unique<BackupActions>(m_bench->workbench(), m_window.get());
        m_said.clear();
        connect(m_actions.get(), &BackupActions::posted, this,
                [this](const Message &message) { m_said << message.text; });
        m_actions->setDevice(m_device);
        m_folder = std::make_unique<QTemporaryDir>();
    }
    void cleanup()
    {
        m_actions.reset();
        m_window.reset();
        m_bench.reset();
    }

    void thereAndBack()
    {
        const QString path = m_folder->filePath(u"arm.yaml"_s);
        trigger("backupAction");
        QVERIFY(giveName(u"saveDialog"_s, path));
        QTRY_VERIFY(QFile::exists(path));
        QTRY_VERIFY(!m_said.isEmpty() && m_said.last().contains(u"is backed up in"));

        QVERIFY(write(u"Position P Gain", 700));
        QVERIFY(write(u"LED", 1));
        trigger("compareAction");
        QDialog *compare = dialog("compareDialog");
        QVERIFY(compare);
        auto *view = compare->findChild<QTreeView *>(u"compareView"_s);
        auto *restore = compare->findChild<QPushButton *>(u"restoreSelectedButton"_s);
        QVERIFY(!restore->isEnabled());
        auto *with = compare->findChild<QComboBox *>(u"compareWith"_s);
        with->setFocus();
        QTest::keyClick(with, Qt::Key_Down); // a backup's file
        QVERIFY(giveName(u"openDialog"_s, path));
        QTRY_COMPARE(namesOf(*view), (QStringList{u"LED"_s, u"Position P Gain"_s}));
        const QModelIndex status = view->model()->index(1, static_cast<int>(CompareColumn::Status));
        QCOMPARE(status.data().toString(), u"differs"_s);
        QVERIFY(!status.data(Qt::DecorationRole).value<QIcon>().isNull());

        auto *only = compare->findChild<QCheckBox *>(u"onlyDifferences"_s);
        QTest::mouseClick(only, Qt::LeftButton, {}, QPoint(8, only->height() / 2));
        QVERIFY(view->model()->rowCount() > 50);
        auto *filter = compare->findChild<QLineEdit *>(u"compareFilter"_s);
        filter->setFocus();
        QTest::keyClicks(filter, u"position_p"_s);
        QCOMPARE(namesOf(*view), QStringList{u"Position P Gain"_s});
        QTest::mouseClick(view->viewport(), Qt::LeftButton, {}, view->visualRect(view->model()->index(0, 0)).center());
        QVERIFY(restore->isEnabled());
        QTest::mouseClick(restore, Qt::LeftButton);
        QDialog *dry = dialog("restoreDialog");
        QVERIFY(dry);
        auto *list = dry->findChild<QPlainTextEdit *>(u"restoreList"_s);
        QTRY_VERIFY2(list->toPlainText().contains(u"Position P Gain: 700 → 800"), qPrintable(list->toPlainText()));
        QVERIFY(!list->toPlainText().contains(u"LED: On → Off"));
        auto *accept = dry->findChild<QPushButton *>(u"acceptButton"_s);
        QVERIFY(accept->isEnabled());
        QTest::mouseClick(accept, Qt::LeftButton);
        QTRY_COMPARE(m_device->raw(u"Position P Gain"), 800);
        QCOMPARE(m_device->raw(u"LED"), 1);
    }

    void twoFilesBesideEachOther()
    {
        const auto saveAs = [this](const QString &path) {
            trigger("backupAction");
            QVERIFY(giveName(u"saveDialog"_s, path));
            QTRY_VERIFY(QFile::exists(path));
        };
        const QString before = m_folder->filePath(u"before.yaml"_s), after = m_folder->filePath(u"after.yaml"_s);
        saveAs(before);
        QVERIFY(write(u"Position P Gain", 700));
        saveAs(after);
        m_actions->setDevice(nullptr); // nothing is connected or selected
        trigger("compareAction");
        QDialog *compare = dialog("compareDialog");
        QVERIFY(compare);
        auto *of = compare->findChild<QComboBox *>(u"compareOf"_s), *with = compare->findChild<QComboBox *>(u"compareWith"_s);
        auto *summary = compare->findChild<QLabel *>(u"compareSummary"_s);
        auto *view = compare->findChild<QTreeView *>(u"compareView"_s);
        QCOMPARE(compare->focusWidget(), of);
        QTest::keyClick(of, Qt::Key_Down);
        QVERIFY(giveName(u"openDialog"_s, before));
        QTRY_COMPARE(of->currentText(), u"before.yaml"_s);
        QCOMPARE(summary->text(), u"Choose two: devices, or backups' files."_s);
        QTest::keyClick(with, Qt::Key_Down);
        QVERIFY(giveName(u"openDialog"_s, after));
        QTRY_COMPARE(namesOf(*view), QStringList{u"Position P Gain"_s});
        const auto text = [view](CompareColumn column) {
            return view->model()->index(0, static_cast<int>(column)).data().toString();
        };
        QCOMPARE(text(CompareColumn::Here), u"800"_s);
        QCOMPARE(text(CompareColumn::There), u"700"_s);
        view->selectAll();
        auto *restore = compare->findChild<QPushButton *>(u"restoreSelectedButton"_s);
        QVERIFY(!restore->isEnabled());
        QCOMPARE(restore->toolTip(), u"Only a device can be restored to; choose one under Here"_s);

        // What is no backup is said, and chosen is nothing.
        const QString other = m_folder->filePath(u"other.yaml"_s);
        QFile file(other);
        QVERIFY(file.open(QIODevice::WriteOnly) && file.write("joints: []\n") > 0);
        file.close();
        QTest::keyClick(with, Qt::Key_Home);
        QCOMPARE(with->currentIndex(), 0);
        QCOMPARE(summary->text(), u"Choose two: devices, or backups' files."_s);
        QCOMPARE(view->model()->rowCount(), 0);
        QTest::keyClick(with, Qt::Key_Down);
        QVERIFY(giveName(u"openDialog"_s, other));
        QTRY_COMPARE(with->currentIndex(), 0);
        QVERIFY2(summary->text().contains(u"other.yaml"), qPrintable(summary->text()));
        QCOMPARE(view->model()->rowCount(), 0);
    }

    void aDeviceThatGoesIsSaid()
    {
        trigger("compareAction");
        QDialog *compare = dialog("compareDialog");
        QVERIFY(compare);
        QCOMPARE(compare->findChild<QComboBox *>(u"compareOf"_s)->currentIndex() > 1, true);
        m_bench->session.lines().front()->forget(m_device->key());
        m_device = nullptr;
        QCOMPARE(compare->findChild<QComboBox *>(u"compareOf"_s)->currentIndex(), 0);
        QCOMPARE(compare->findChild<QLabel *>(u"compareSummary"_s)->text(), u"That device is gone."_s);
    }

    void restoresAFile()
    {
        const QString path = m_folder->filePath(u"arm.yaml"_s);
        trigger("backupAction");
        QVERIFY(giveName(u"saveDialog"_s, path));
        QTRY_VERIFY(QFile::exists(path));
        QVERIFY(write(u"Current Limit", 300));
        QVERIFY(write(u"Torque Enable", 1));
        trigger("restoreAction");
        QVERIFY(giveName(u"openDialog"_s, path));
        QDialog *dry = nullptr;
        QTRY_VERIFY((dry = dialog("restoreDialog")));
        auto *accept = dry->findChild<QPushButton *>(u"acceptButton"_s);
        auto *note = dry->findChild<QLabel *>(u"note"_s);
        QTRY_COMPARE(note->text(), u"Torque is on, which locks the EEPROM."_s);
        QVERIFY(!accept->isEnabled());
        auto *off = dry->findChild<QCheckBox *>(u"turnTorqueOff"_s);
        QTest::mouseClick(off, Qt::LeftButton, {}, QPoint(8, off->height() / 2));
        QVERIFY(accept->isEnabled());
        accept->setFocus();
        QTest::keyClick(accept, Qt::Key_Space);
        QTRY_COMPARE(m_device->raw(u"Current Limit"), 1193);
        QTRY_COMPARE(m_device->raw(u"Torque Enable"), 0);
    }

    void severalGoToAFolder()
    {
        m_actions->setDevices({m_device, m_bench->device(4, 1000000)});
        trigger("backupAction");
        QFileDialog *asked = nullptr;
        QTRY_VERIFY((asked = m_window->findChild<QFileDialog *>(u"folderDialog"_s)));
        m_actions->setDevice(nullptr); // another selection meanwhile
        asked->selectFile(m_folder->path());
        static_cast<QDialog *>(asked)->accept();
        QTRY_COMPARE(QDir(m_folder->path()).entryList({u"*.yaml"_s}).size(), 2);
        QTRY_COMPARE(m_said, QStringList(u"2 devices are backed up in %1"_s.arg(m_folder->path())));
    }

    void refusesAnotherModelsFile()
    {
        const QString path = m_folder->filePath(u"other.yaml"_s);
        m_actions->setDevice(m_bench->device(4, 1000000));
        trigger("backupAction");
        QVERIFY(giveName(u"saveDialog"_s, path));
        QTRY_VERIFY(QFile::exists(path));
        m_actions->setDevice(m_device);
        trigger("restoreAction");
        QVERIFY(giveName(u"openDialog"_s, path));
        QDialog *dry = nullptr;
        QTRY_VERIFY((dry = dialog("restoreDialog")));
        QTRY_VERIFY(dry->findChild<QLabel *>(u"note"_s)->text().contains(u"is the backup of a XL430-W250"));
        QVERIFY(!dry->findChild<QPushButton *>(u"acceptButton"_s)->isEnabled());
    }

    void inTheServo()
    {
        QVERIFY(write(u"Return Delay Time", 3));
        QVERIFY(write(u"Torque Enable", 1));
        trigger("inServoBackupAction");
        QDialog *store = dialog("inServoBackupDialog");
        QVERIFY(store);
        auto *accept = store->findChild<QPushButton *>(u"acceptButton"_s);
        QVERIFY(!accept->isEnabled());
        QVERIFY(store->findChild<QLabel *>(u"note"_s)->text().contains(u"torque is on"));
        QVERIFY(write(u"Torque Enable", 0));
        QTRY_VERIFY(accept->isEnabled());
        QTest::mouseClick(accept, Qt::LeftButton);
        QTRY_COMPARE(m_device->raw(u"Backup Ready"), 1);
        QVERIFY(write(u"Return Delay Time", 100));
        trigger("inServoRestoreAction");
        QDialog *recall = dialog("inServoRestoreDialog");
        QVERIFY(recall);
        QTest::mouseClick(recall->findChild<QPushButton *>(u"acceptButton"_s), Qt::LeftButton);
        QTRY_COMPARE_WITH_TIMEOUT(m_device->raw(u"Return Delay Time"), 3, 10000);
    }

    void isOfferedWhereItCanBe()
    {
        QVERIFY(m_actions->actions().at(3)->isEnabled());
        m_actions->setDevice(nullptr);
        for (const QAction *one : m_actions->actions()) // two files need no device
            QCOMPARE(one->isEnabled(), one->objectName() == u"compareAction");
    }

private:
    void trigger(const char *name)
    {
        for (QAction *one : m_actions->actions()) {
            if (one->objectName() == QLatin1String(name))
                one->trigger();
        }
    }
    QDialog *dialog(const char *name) const
    {
        for (QWidget *widget : QApplication::topLevelWidgets()) {
            if (widget->objectName() == QLatin1String(name) && widget->isVisible())
                return qobject_cast<QDialog *>(widget);
        }
        return nullptr;
    }
    /// Types a path into a file dialog, once it is there.
    bool giveName(const QString &dialogName, const QString &path)
    {
        QDialog *asking = nullptr;
        if (!QTest::qWaitFor([&] { return (asking = dialog(dialogName.toLatin1().constData())) != nullptr; }))
            return false;
        auto *name = asking->findChild<QLineEdit *>(u"fileNameEdit"_s);
        name->setText(path); // pasted: what is typed brings up suggestions, whose Return is another
        QTest::keyClick(name, Qt::Key_Return);
        return QTest::qWaitFor([&] { return dialog(dialogName.toLatin1().constData()) == nullptr; });
    }
    bool write(QStringView name, std::int64_t raw)
    {
        std::optional<bool> fine;
        m_bench->commands.writeField(*m_device, m_device->table().indexOf(name), raw,
                                     [&fine](const Result<void> &result) { fine = result.has_value(); });
        return QTest::qWaitFor([&] { return fine.has_value(); }) && *fine;
    }
    static QStringList namesOf(const QTreeView &view)
    {
        QStringList names;
        for (int row = 0; row < view.model()->rowCount(); ++row)
            names << view.model()->index(row, 0).data().toString();
        return names;
    }

    std::unique_ptr<test::WorkbenchFixture> m_bench;
    std::unique_ptr<QMainWindow> m_window;
    std::unique_ptr<BackupActions> m_actions;
    std::unique_ptr<QTemporaryDir> m_folder;
    QStringList m_said;
    Device *m_device = nullptr;
};

DYNASCOPE_UI_TEST(TestBackups)
#include "tst_backups.moc"
