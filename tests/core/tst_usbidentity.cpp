// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/usbidentity.h"
#include "tests/support/testmain.h"

#include <QDir>
#include <QFile>

using namespace dynascope;
using namespace Qt::StringLiterals;

/// The system's files as Linux lays them out, in a folder of the test's own.
class TestUsbIdentity : public QObject
{
    Q_OBJECT

private slots:
    void init() { m_root = std::make_unique<QTemporaryDir>(); }

    void anFtdiAdapter()
    {
        device(u"usb1/1-2"_s, u"0403"_s, u"6014"_s, u"FT1A2B"_s, 7);
        port(u"ttyUSB0"_s, u"usb1/1-2"_s, u"1-2:1.0/ttyUSB0"_s, u"00"_s, u"0"_s);
        const UsbIdentity usb = usbIdentity(u"ttyUSB0"_s, ports());
        QCOMPARE(usb.identity, u"0403:6014:FT1A2B:00.0"_s);
        QCOMPARE(usb.plug, u"1-7"_s);
    }

    void theSameElsewhere()
    {
        device(u"usb2/2-4"_s, u"0403"_s, u"6014"_s, u"FT1A2B"_s, 9);
        port(u"ttyUSB1"_s, u"usb2/2-4"_s, u"2-4:1.0/ttyUSB1"_s, u"00"_s, u"0"_s);
        const UsbIdentity usb = usbIdentity(u"ttyUSB1"_s, ports());
        QCOMPARE(usb.identity, u"0403:6014:FT1A2B:00.0"_s);
        QCOMPARE(usb.plug, u"1-9"_s); // plugged in anew
    }

    void severalPortsOfOneAdapter()
    {
        device(u"usb1/1-2"_s, u"0403"_s, u"6011"_s, u"FT4"_s, 7);
        port(u"ttyUSB0"_s, u"usb1/1-2"_s, u"1-2:1.0/ttyUSB0"_s, u"00"_s, u"0"_s);
        port(u"ttyUSB1"_s, u"usb1/1-2"_s, u"1-2:1.1/ttyUSB1"_s, u"01"_s, u"0"_s);
        QVERIFY(usbIdentity(u"ttyUSB0"_s, ports()).identity != usbIdentity(u"ttyUSB1"_s, ports()).identity);
    }

    void aModemClassAdapter() // OpenCR: the port's device is the interface itself
    {
        device(u"usb1/1-2"_s, u"0483"_s, u"5740"_s, u"FFFFFFFEFFFF"_s, 3);
        port(u"ttyACM0"_s, u"usb1/1-2"_s, u"1-2:1.0"_s, u"00"_s, {});
        QCOMPARE(usbIdentity(u"ttyACM0"_s, ports()).identity, u"0483:5740:FFFFFFFEFFFF:00"_s);
    }

    void withoutASerialNumber()
    {
        device(u"usb1/1-2"_s, u"1a86"_s, u"7523"_s, {}, 4);
        port(u"ttyUSB0"_s, u"usb1/1-2"_s, u"1-2:1.0/ttyUSB0"_s, u"00"_s, {});
        QCOMPARE(usbIdentity(u"ttyUSB0"_s, ports()).identity, QString());
        QCOMPARE(usbIdentity(u"ttyUSB0"_s, ports()).plug, u"1-4"_s);
    }

    void noUsbAtAll()
    {
        QVERIFY(QDir(m_root->path()).mkpath(u"devices/platform/serial8250/tty"_s));
        QVERIFY(QDir(m_root->path()).mkpath(u"class/tty/ttyS0"_s));
        QVERIFY(QFile::link(m_root->filePath(u"devices/platform/serial8250"_s),
                            m_root->filePath(u"class/tty/ttyS0/device"_s)));
        for (const QString &name : {u"ttyS0"_s, u"ttyUSB9"_s, QString()}) {
            QCOMPARE(usbIdentity(name, ports()).identity, QString());
            QCOMPARE(usbIdentity(name, ports()).plug, QString());
        }
        QCOMPARE(usbIdentity(u"ttyUSB0"_s, u"/nowhere"_s).identity, QString());
    }

private:
    QString ports() const { return m_root->filePath(u"class/tty"_s); }

    void write(const QString &path, const QString &text)
    {
        if (text.isEmpty())
            return;
        QFile file(m_root->filePath(path));
        QVERIFY(QDir().mkpath(QFileInfo(file).path()) && file.open(QIODevice::WriteOnly));
        file.write(text.toUtf8() + '\n');
    }
    void device(const QString &place, const QString &vendor, const QString &product, const QString &serial, int number)
    {
        const QString folder = u"devices/"_s + place + u'/';
        write(folder + u"idVendor"_s, vendor);
        write(folder + u"idProduct"_s, product);
        write(folder + u"serial"_s, serial);
        write(folder + u"busnum"_s, u"1"_s);
        write(folder + u"devnum"_s, QString::number(number));
    }
    void port(const QString &name, const QString &place, const QString &below, const QString &interface,
              const QString &number)
    {
        const QString folder = u"devices/"_s + place + u'/' + below;
        QVERIFY(QDir(m_root->path()).mkpath(folder));
        write(u"devices/"_s + place + u'/' + below.section(u'/', 0, 0) + u"/bInterfaceNumber"_s, interface);
        write(folder + u"/port_number"_s, number);
        QVERIFY(QDir(m_root->path()).mkpath(u"class/tty/"_s + name));
        QVERIFY(QFile::link(m_root->filePath(folder), m_root->filePath(u"class/tty/"_s + name + u"/device"_s)));
    }

    std::unique_ptr<QTemporaryDir> m_root;
};

DYNASCOPE_CORE_TEST(TestUsbIdentity)
#include "tst_usbidentity.moc"
