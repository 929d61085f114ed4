// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/networkaddress_values.h"
#include "tests/support/testmain.h"

using namespace dynascope;

class TestNetworkAddress : public QObject
{
    Q_OBJECT

private slots:
    void right_data()
    {
        QTest::addColumn<NetworkAddress>("expected");
        const auto row = [](const char *name, const NetworkAddress &expected) { QTest::newRow(name) << expected; };
        constexpr auto Raw = NetworkAddress::Kind::Raw;
        constexpr auto Control = NetworkAddress::Kind::Rfc2217;
        row("tcp://localhost:4000", {Raw, QStringLiteral("localhost"), 4000, 0});
        row("TCP://192.168.1.7:1", {Raw, QStringLiteral("192.168.1.7"), 1, 0});
        row("tcp://[::1]:65535", {Raw, QStringLiteral("::1"), 65535, 0});
        row("tcp://[fe80::1%eth0]:4000", {Raw, QStringLiteral("fe80::1%eth0"), 4000, 0});
        row("tcp://lab-pi.local:4000?baud=1000000", {Raw, QStringLiteral("lab-pi.local"), 4000, 1'000'000});
        row("rfc2217://my_host:2217", {Control, QStringLiteral("my_host"), 2217, 0});
        row("rfc2217://[2001:db8::2]:2217", {Control, QStringLiteral("2001:db8::2"), 2217, 0});
    }
    void right()
    {
        QFETCH(NetworkAddress, expected);
        const QString name = QString::fromLatin1(QTest::currentDataTag());
        QVERIFY(NetworkAddress::isNetworkName(name));
        QCOMPARE(isRateTheServers(name), expected.kind == NetworkAddress::Kind::Raw);
        const auto address = NetworkAddress::parse(name);
        QVERIFY2(address, address ? "" : qPrintable(address.error().text));
        QVERIFY(*address == expected);
    }

    void wrong_data()
    {
        QTest::addColumn<QString>("says");
        const QString form = QStringLiteral("is no address");
        const QString number = QStringLiteral("a port is a number from 1 to 65535");
        for (const char *name : {"tcp://",
                                 "tcp://host",
                                 "tcp://:4000",
                                 "tcp://::1:4000",
                                 "tcp://[::1]",
                                 "tcp://[::1]4000",
                                 "tcp://[::1:4000",
                                 "tcp://[]:4000",
                                 "tcp://ho st:4000",
                                 "tcp://user@host:4000",
                                 "tcp://host/x:4000",
                                 "tcp://host:4000?baud=",
                                 "tcp://host:4000?baud=-1",
                                 "tcp://host:4000?baud=fast",
                                 "tcp://host:4000?rate=9600",
                                 "tcp://host:4000?baud=99999999999",
                                 "rfc2217://h\xC3\xB6st:4000",
                                 "/dev/ttyUSB0",
                                 "http://host:80",
                                 ""})
            QTest::newRow(name) << form;
        for (const char *name : {"tcp://host:", "tcp://host:0", "tcp://host:65536", "tcp://host:99999999999999999999",
                                 "tcp://host:-1", "tcp://host:+1", "tcp://host:4000/", "tcp://host:http",
                                 "tcp://host: 4000", "rfc2217://host:4000?baud=9600"})
            QTest::newRow(name) << number;
    }
    void wrong()
    {
        QFETCH(QString, says);
        const auto address = NetworkAddress::parse(QString::fromUtf8(QTest::currentDataTag()));
        QVERIFY(!address);
        QCOMPARE(address.error().kind, ErrorKind::PortUnsuitable);
        QVERIFY2(address.error().text.contains(says), qPrintable(address.error().text));
    }

    void endlessNamesAreRefused()
    {
        QVERIFY(!NetworkAddress::parse(QStringLiteral("tcp://%1:4000").arg(QString(254, u'a'))));
        QVERIFY(NetworkAddress::parse(QStringLiteral("tcp://%1:4000").arg(QString(253, u'a'))));
    }

    void whoClaimsToBeOne()
    {
        QVERIFY(NetworkAddress::isNetworkName(u"tcp://nonsense"));
        QVERIFY(NetworkAddress::isNetworkName(u"RFC2217://"));
        QVERIFY(!NetworkAddress::isNetworkName(u"/dev/ttyUSB0"));
        QVERIFY(!NetworkAddress::isNetworkName(u"sim"));
        QVERIFY(!isRateTheServers(u"rfc2217://host:1"));
        QVERIFY(!isRateTheServers(u"COM3"));
    }
};

DYNASCOPE_CORE_TEST(TestNetworkAddress)
#include "tst_networkaddress.moc"
