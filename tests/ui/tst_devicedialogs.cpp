// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/devices/changebauddialog.h"
#include "ui/devices/changeiddialog.h"
#include "ui/devices/factoryresetdialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QSpinBox>

using namespace dynascope;

namespace {

bool canAccept(const QDialog &dialog)
{
    return dialog.findChild<QPushButton *>(QStringLiteral("acceptButton"))->isEnabled();
}

QString note(const QDialog &dialog)
{
    return dialog.findChild<QLabel *>(QStringLiteral("note"))->text();
}

void setTorque(Device &device, bool on)
{
    PollValue value;
    value.address = 64;
    value.data = {static_cast<std::uint8_t>(on)};
    device.take(value);
}

} // namespace

class TestDeviceDialogs : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_bench = std::make_unique<test::WorkbenchFixture>();
        m_line = &m_bench->session.open(QStringLiteral("sim"), 1000000);
        QTRY_COMPARE(m_line->state(), BusThread::State::Open);
        m_bench->scanner.start(*m_line, {{57600, 1000000}, 0, 252});
        QTRY_VERIFY(!m_bench->scanner.isRunning());
        QCOMPARE(m_bench->session.devices().size(), std::size_t(3));
        m_device = m_bench->device(1, 1000000);
        QVERIFY(m_device);
    }
    void cleanup() { m_bench.reset(); }

    void idRefusesWhatIsTaken()
    {
        ChangeIdDialog dialog(*m_device, m_bench->commands, nullptr);
        auto *id = dialog.findChild<QSpinBox *>(QStringLiteral("newId"));
        QCOMPARE(id->minimum(), 0);
        QCOMPARE(id->maximum(), 252);
        QCOMPARE(id->value(), 2); // the first that is free
        QVERIFY(canAccept(dialog));
        id->setValue(4);
        QVERIFY(!canAccept(dialog));
        QVERIFY2(note(dialog).contains(QStringLiteral("XL430-W250")), qPrintable(note(dialog)));
        id->setValue(1);
        QVERIFY(!canAccept(dialog));
        id->setValue(252);
        QVERIFY(canAccept(dialog));
    }

    void aSecondaryIdIsTakenToo()
    {
        Device *other = m_bench->device(4, 1000000);
        other->takeReadBack(other->table().indexOf(u"Secondary ID"), 77);
        ChangeIdDialog dialog(*m_device, m_bench->commands, nullptr);
        QCOMPARE(dialog.findChild<QLabel *>(QStringLiteral("takenIds"))->text(), QStringLiteral("4, 77"));
        dialog.findChild<QSpinBox *>(QStringLiteral("newId"))->setValue(77);
        QVERIFY(!canAccept(dialog));
    }

    void anIdAtAnotherRateIsFree()
    {
        ChangeIdDialog dialog(*m_bench->device(1, 57600), m_bench->commands, nullptr);
        auto *id = dialog.findChild<QSpinBox *>(QStringLiteral("newId"));
        QCOMPARE(id->value(), 2); // which is free here and there: 4 is not suggested
        id->setValue(4);
        QVERIFY(canAccept(dialog));
    }

    void theIdSuggestedIsFreeAtEveryRate()
    {
        m_line->heard({2, 57600, 1020, 45, false, {}});
        m_line->heard({3, 1000000, 1020, 45, false, {}});
        for (const int baudRate : {57600, 1000000}) {
            ChangeIdDialog dialog(*m_bench->device(1, baudRate), m_bench->commands, nullptr);
            QCOMPARE(dialog.findChild<QSpinBox *>(QStringLiteral("newId"))->value(), 5);
        }
    }

    void idNeedsTorqueOff()
    {
        ChangeIdDialog dialog(*m_device, m_bench->commands, nullptr);
        auto *box = dialog.findChild<QCheckBox *>(QStringLiteral("turnTorqueOff"));
        QVERIFY(box->isHidden());
        setTorque(*m_device, true); // while the dialog is open
        QVERIFY(!box->isHidden());
        QVERIFY(!canAccept(dialog));
        box->setChecked(true);
        QVERIFY(canAccept(dialog));
        box->setChecked(false);
        setTorque(*m_device, false);
        QVERIFY(canAccept(dialog));
        QVERIFY(box->isHidden());
    }

    void idIsChanged()
    {
        auto *dialog = new ChangeIdDialog(*m_device, m_bench->commands, nullptr);
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        dialog->open();
        dialog->findChild<QSpinBox *>(QStringLiteral("newId"))->setValue(17);
        QTest::mouseClick(dialog->findChild<QPushButton *>(QStringLiteral("acceptButton")), Qt::LeftButton);
        QTRY_COMPARE(int(m_device->id()), 17);
    }

    void closesWhenItsDeviceGoes()
    {
        auto *dialog = new ChangeIdDialog(*m_device, m_bench->commands, nullptr);
        const QPointer<QDialog> watch(dialog);
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        dialog->open();
        m_line->forget(m_device->key());
        QTRY_VERIFY(!watch);
    }

    void baudOffersWhatTheModelHas()
    {
        ChangeBaudDialog dialog(*m_device, m_bench->commands, nullptr);
        auto *baud = dialog.findChild<QComboBox *>(QStringLiteral("newBaud"));
        QCOMPARE(baud->count(), static_cast<int>(m_device->table().description().baudCodes.size()) - 1);
        QCOMPARE(baud->findData(1000000), -1);
        QVERIFY(canAccept(dialog)); // it doesn't begin with 57 600, where its ID is taken
    }

    void baudSaysWhatFollows()
    {
        ChangeBaudDialog dialog(*m_device, m_bench->commands, nullptr);
        auto *baud = dialog.findChild<QComboBox *>(QStringLiteral("newBaud"));
        baud->setCurrentIndex(baud->findData(2000000));
        QVERIFY(canAccept(dialog));
        QVERIFY2(note(dialog).contains(QStringLiteral("parked")), qPrintable(note(dialog)));
        baud->setCurrentIndex(baud->findData(57600)); // where ID 1 is another one
        QVERIFY(!canAccept(dialog));

        m_line->forget(m_bench->device(4, 1000000)->key());
        ChangeBaudDialog alone(*m_device, m_bench->commands, nullptr);
        auto *other = alone.findChild<QComboBox *>(QStringLiteral("newBaud"));
        other->setCurrentIndex(other->findData(2000000));
        QVERIFY2(note(alone).contains(QStringLiteral("follows")), qPrintable(note(alone)));
    }

    void aParkedOneJoins()
    {
        m_line->moveDevice(*m_device, {2, 1000000, 1020, 45, false, {}});
        ChangeBaudDialog dialog(*m_bench->device(1, 57600), m_bench->commands, nullptr);
        QCOMPARE(dialog.findChild<QComboBox *>(QStringLiteral("newBaud"))->currentData().toInt(), 1000000);
        QVERIFY2(note(dialog).contains(QStringLiteral("joins")), qPrintable(note(dialog)));
    }

    void resetTellsWhatSurvives()
    {
        FactoryResetDialog dialog(*m_device, m_bench->commands, nullptr);
        QVERIFY(dialog.findChild<QRadioButton *>(QStringLiteral("resetKeepIdAndBaud"))->isChecked());
        QVERIFY(canAccept(dialog));
        QVERIFY(dialog.findChild<QRadioButton *>(QStringLiteral("resetKeepId"))
                    ->accessibleDescription()
                    .contains(QStringLiteral("57\u2009600")));
        // The fresh one stands at ID 1 and 57 600 already.
        dialog.findChild<QRadioButton *>(QStringLiteral("resetAll"))->setChecked(true);
        QVERIFY(!canAccept(dialog));
        dialog.findChild<QRadioButton *>(QStringLiteral("resetKeepIdAndBaud"))->setChecked(true);
        setTorque(*m_device, true);
        QVERIFY(canAccept(dialog));
        QVERIFY2(note(dialog).contains(QStringLiteral("fall")), qPrintable(note(dialog)));
        QVERIFY(dialog.findChild<QCheckBox *>(QStringLiteral("turnTorqueOff"))->isHidden());
    }

private:
    std::unique_ptr<test::WorkbenchFixture> m_bench;
    LineSession *m_line = nullptr;
    Device *m_device = nullptr;
};

DYNASCOPE_UI_TEST(TestDeviceDialogs)
#include "tst_devicedialogs.moc"
