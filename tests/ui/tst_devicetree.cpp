// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/devices/devicetreemodel.h"

#include <QAbstractItemModelTester>
#include <QItemSelectionModel>
#include <QSignalSpy>

using namespace dynascope;

namespace {

/// The tree as lines of text, children indented.
QStringList picture(const QAbstractItemModel &model, const QModelIndex &parent = {}, int depth = 0)
{
    QStringList lines;
    for (int row = 0; row < model.rowCount(parent); ++row) {
        const QModelIndex index = model.index(row, 0, parent);
        const QVariant id = index.data(DeviceTreeModel::IdRole);
        QString text = QString(depth, QLatin1Char(' ')) + index.data(Qt::DisplayRole).toString();
        if (id.isValid())
            text += QStringLiteral(" #%1").arg(id.toInt());
        if (index.data(DeviceTreeModel::DimmedRole).toBool())
            text += QStringLiteral(" (dimmed)");
        lines << text;
        lines += picture(model, index, depth + 1);
    }
    return lines;
}

Found found(int id, int baud, int model = 1020, int firmware = 45)
{
    Found result;
    result.id = static_cast<std::uint8_t>(id);
    result.baudRate = baud;
    result.modelNumber = static_cast<std::uint16_t>(model);
    result.firmware = static_cast<std::uint8_t>(firmware);
    return result;
}

} // namespace

class TestDeviceTree : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_bench = std::make_unique<test::WorkbenchFixture>();
        m_model = std::make_unique<DeviceTreeModel>(m_bench->session);
        m_tester = std::make_unique<QAbstractItemModelTester>(m_model.get(),
                                                              QAbstractItemModelTester::FailureReportingMode::QtTest);
        m_line = &m_bench->session.open(QStringLiteral("sim"), 1000000);
        QTRY_COMPARE(m_line->state(), BusThread::State::Open);
    }

    void cleanup()
    {
        m_tester.reset();
        m_model.reset();
        m_bench.reset();
    }

    void growsInOrder()
    {
        QCOMPARE(picture(*m_model), QStringList{QStringLiteral("Simulated bus")});
        m_line->heard(found(3, 1000000));
        m_line->heard(found(1, 57600, 1200, 53));
        m_line->heard(found(1, 1000000, 1060));
        m_line->heard(found(200, 1000000, 4711));
        QCOMPARE(picture(*m_model),
                 QStringList({QStringLiteral("Simulated bus"), QStringLiteral(" 57\u2009600 bps (dimmed)"),
                              QStringLiteral("  XL330-M288 #1 (dimmed)"), QStringLiteral(" 1 Mbps"),
                              QStringLiteral("  XL430-W250 #1"), QStringLiteral("  XM430-W350 #3"),
                              QStringLiteral("  unknown model 4711 #200")}));
    }

    void aDeviceMovesWithItsSelection_data()
    {
        QTest::addColumn<int>("id");
        QTest::addColumn<int>("baud");
        QTest::addColumn<QString>("expected"); ///< rows of devices, in order
        QTest::newRow("nowhere") << 4 << 1000000 << "1 4 7";
        QTest::newRow("up") << 0 << 1000000 << "0 1 7";
        QTest::newRow("down") << 9 << 1000000 << "1 7 9";
        QTest::newRow("in between") << 5 << 1000000 << "1 5 7";
        QTest::newRow("to another rate") << 4 << 57600 << "4 1 7";
        QTest::newRow("to another rate, other ID") << 9 << 2000000 << "1 7 9";
    }

    void aDeviceMovesWithItsSelection()
    {
        QFETCH(int, id);
        QFETCH(int, baud);
        QFETCH(QString, expected);
        for (const int each : {1, 4, 7})
            m_line->heard(found(each, 1000000));
        Device *device = m_line->deviceAt(4, 1000000);
        QItemSelectionModel selection(m_model.get());
        selection.select(m_model->indexOf(device), QItemSelectionModel::Select);
        QSignalSpy removed(m_model.get(), &QAbstractItemModel::rowsRemoved);

        m_line->moveDevice(*device, found(id, baud));

        QStringList ids;
        for (const QString &row : picture(*m_model)) {
            if (row.contains(QLatin1Char('#')))
                ids << row.section(QLatin1Char('#'), 1).section(QLatin1Char(' '), 0, 0);
        }
        QCOMPARE(ids.join(QLatin1Char(' ')), expected);
        QCOMPARE(selection.selectedIndexes().size(), 1);
        QCOMPARE(m_model->device(selection.selectedIndexes().first()), device);
        QCOMPARE(removed.count(), 0);
    }

    void anEmptyRateGoes()
    {
        m_line->heard(found(1, 57600));
        m_line->heard(found(2, 1000000));
        m_line->moveDevice(*m_line->deviceAt(1, 57600), found(1, 1000000));
        QCOMPARE(picture(*m_model),
            QStringList({QStringLiteral("Simulated bus"), QStringLiteral(" 1 Mbps"), QStringLiteral("  XM430-W350 #1"),
                QStringLiteral("  XM430-W350 #2")}));
        m_line->forget(m_line->deviceAt(1, 1000000)->key());
        m_line->forget(m_line->deviceAt(2, 1000000)->key());
        QCOMPARE(picture(*m_model), QStringList{QStringLiteral("Simulated bus")});
    }

    void theWorkingRateMoves()
    {
        m_line->heard(found(1, 57600));
        m_line->heard(found(2, 1000000));
        m_line->setWorkingBaudRate(57600);
        QCOMPARE(picture(*m_model),
                 QStringList({QStringLiteral("Simulated bus"), QStringLiteral(" 57\u2009600 bps"),
                              QStringLiteral("  XM430-W350 #1"), QStringLiteral(" 1 Mbps (dimmed)"),
                              QStringLiteral("  XM430-W350 #2 (dimmed)")}));
    }

    void saysWhatItKnows()
    {
        m_line->heard(found(1, 1000000));
        Device *device = m_line->deviceAt(1, 1000000);
        const QModelIndex index = m_model->indexOf(device);
        QCOMPARE(index.data(DeviceTreeModel::SubtitleRole).toString(), QStringLiteral("Present"));
        QVERIFY(!index.data(DeviceTreeModel::TorqueRole).isValid());

        QSignalSpy changed(m_model.get(), &QAbstractItemModel::dataChanged);
        PollValue torque;
        torque.address = 64;
        torque.data = {1};
        device->take(torque);
        QCOMPARE(index.data(DeviceTreeModel::SubtitleRole).toString(), QStringLiteral("Torque on"));
        QVERIFY(index.data(DeviceTreeModel::TorqueRole).toBool());
        QCOMPARE(changed.count(), 1);

        // What the row doesn't show must not repaint it: positions come a thousand times a second.
        PollValue position;
        position.address = 132;
        position.data = {1, 2, 0, 0};
        device->take(position);
        QCOMPARE(changed.count(), 1);

        device->setNickname(QStringLiteral("Elbow"));
        QCOMPARE(index.data(Qt::DisplayRole).toString(), QStringLiteral("Elbow"));
        QVERIFY(index.data(DeviceTreeModel::SubtitleRole).toString().contains(QStringLiteral("XM430-W350")));

        PollValue error;
        error.address = 70;
        error.data = {4};
        device->take(error);
        device->setAlert(true);
        QCOMPARE(index.data(DeviceTreeModel::AlertRole).toString(), QStringLiteral("Overheating"));
        QVERIFY(index.data(DeviceTreeModel::SubtitleRole).toString().startsWith(QStringLiteral("Overheating")));
    }

    void aSilentOneIsToldWithThoseThatAnswer()
    {
        m_line->heard(found(1, 1000000));
        Device *device = m_line->deviceAt(1, 1000000);
        device->setState(Device::State::Silent);
        const auto help = [&] { return m_model->indexOf(device).data(Qt::ToolTipRole).toString(); };
        const QString question = QStringLiteral(". Is it powered, and still at this ID and baud rate?");
        QVERIFY2(help().contains(QStringLiteral("; nothing else on the line has answered lately") + question),
                 qPrintable(help()));
        m_line->heard(found(3, 1000000));
        m_line->heard(found(4, 57600)); // parked: not asked
        QVERIFY2(help().contains(QStringLiteral("; device 3 on this line answers") + question), qPrintable(help()));
        m_line->heard(found(7, 1000000));
        QVERIFY2(help().contains(QStringLiteral("; devices 3, 7 on this line answer") + question), qPrintable(help()));
        m_line->deviceAt(3, 1000000)->setState(Device::State::Silent);
        QVERIFY2(help().contains(QStringLiteral("; device 7 on this line answers") + question), qPrintable(help()));
    }

    void aSilentOneIsDimmed()
    {
        m_line->heard(found(1, 1000000));
        m_line->deviceAt(1, 1000000)->setState(Device::State::Silent);
        const QModelIndex index = m_model->indexOf(m_line->deviceAt(1, 1000000));
        QVERIFY(index.data(DeviceTreeModel::DimmedRole).toBool());
        QVERIFY(index.data(DeviceTreeModel::SubtitleRole).toString().startsWith(QStringLiteral("Does not answer")));
    }

    void aDeviceThatAnswersOnlyPingIsSaidToDoJustThat()
    {
        m_line->heard(found(1, 1000000));
        Device *device = m_line->deviceAt(1, 1000000);
        const QModelIndex index = m_model->indexOf(device);
        device->setState(Device::State::Silent);
        device->setAnswersOnlyPing(true);
        QCOMPARE(index.data(DeviceTreeModel::SubtitleRole).toString(), QStringLiteral("Answers Ping but no Read"));
        QVERIFY(index.data(Qt::ToolTipRole).toString().contains(QStringLiteral("Status Return Level")));
        m_line->answered(*device);
        QVERIFY(!device->answersOnlyPing());

        const int torque = device->table().indexOf(Known::TorqueEnable);
        device->takeReadBack(torque, 0);
        QCOMPARE(index.data(DeviceTreeModel::TorqueRole), QVariant(false));
        device->setUnconfirmed(torque, 1, QStringLiteral("nothing came back"));
        QCOMPARE(index.data(DeviceTreeModel::SubtitleRole).toString(),
                 QStringLiteral("Torque on sent, not confirmed"));
        QVERIFY(!index.data(DeviceTreeModel::TorqueRole).isValid());
        device->takeReadBack(torque, 0);
        QCOMPARE(index.data(DeviceTreeModel::SubtitleRole).toString(), QStringLiteral("Torque off"));
    }

    void severalLines()
    {
        m_line->heard(found(1, 1000000));
        LineSession &other = m_bench->session.open(QStringLiteral("/dev/ttyUSB0"), 57600);
        QTRY_COMPARE(other.state(), BusThread::State::Open);
        other.heard(found(1, 57600));
        QCOMPARE(m_model->rowCount(), 2);
        QCOMPARE(m_model->line(m_model->indexOf(other.devices().front().get())), &other);
        m_bench->session.close(*m_line);
        QCOMPARE(picture(*m_model).first(), QStringLiteral("/dev/ttyUSB0"));
        QCOMPARE(picture(*m_model).size(), 3);
        m_line = &other;
    }

    void takesWhatIsThereAlready()
    {
        m_line->heard(found(1, 1000000));
        m_line->heard(found(1, 57600));
        DeviceTreeModel late(m_bench->session);
        QCOMPARE(picture(late), picture(*m_model));
    }

private:
    std::unique_ptr<test::WorkbenchFixture> m_bench;
    std::unique_ptr<DeviceTreeModel> m_model;
    std::unique_ptr<QAbstractItemModelTester> m_tester;
    LineSession *m_line = nullptr;
};

DYNASCOPE_UI_TEST(TestDeviceTree)
#include "tst_devicetree.moc"
