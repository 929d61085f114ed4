// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "ui/common/icons.h"

#include <QDir>
#include <QPainter>

using namespace dynascope;

namespace {

struct Ink {
    int pixels = 0; ///< that are more than half opaque
    QColor color;   ///< of one of them
};

Ink ink(const QPixmap &pixmap)
{
    Ink result;
    const QImage image = pixmap.toImage().convertToFormat(QImage::Format_ARGB32);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const QColor color = image.pixelColor(x, y);
            if (color.alpha() > 127)
                ++result.pixels;
            if (color.alpha() > 250)
                result.color = QColor(color.red(), color.green(), color.blue());
        }
    }
    return result;
}

/// Drawing into a premultiplied image may cost a step or two.
bool isNearly(const QColor &one, const QColor &other)
{
    return qAbs(one.red() - other.red()) < 5 && qAbs(one.green() - other.green()) < 5
        && qAbs(one.blue() - other.blue()) < 5;
}

} // namespace

class TestIcons : public QObject
{
    Q_OBJECT

private slots:
    void init() { applyTheme(*qApp, ColorScheme::Light); }

    void draws_data()
    {
        QTest::addColumn<QString>("name");
        for (const QString &file : QDir(QStringLiteral(":/icons")).entryList({QStringLiteral("*.svg")})) {
            const QString name = file.chopped(4);
            if (name != QStringLiteral("dynascope"))
                QTest::newRow(qPrintable(name)) << name;
        }
    }

    void draws()
    {
        QFETCH(QString, name);
        for (const ColorScheme scheme : {ColorScheme::Light, ColorScheme::Dark}) {
            applyTheme(*qApp, scheme);
            const Ink normal = ink(icon(name).pixmap(QSize(80, 80), 1.0));
            QVERIFY2(normal.pixels > 50, qPrintable(QString::number(normal.pixels)));
            QVERIFY(isNearly(normal.color, dynascope::palette(scheme).color(QPalette::ButtonText)));
            const Ink disabled = ink(icon(name).pixmap(QSize(80, 80), 1.0, QIcon::Disabled));
            QVERIFY(
                isNearly(disabled.color, dynascope::palette(scheme).color(QPalette::Disabled, QPalette::ButtonText)));
        }
    }

    void followsThePalette()
    {
        const QIcon kept = icon(QStringLiteral("warning"), IconTint::Warning);
        const QColor light = ink(kept.pixmap(QSize(80, 80), 1.0)).color;
        applyTheme(*qApp, ColorScheme::Dark);
        const QColor dark = ink(kept.pixmap(QSize(80, 80), 1.0)).color;
        QVERIFY(light != dark);
        QVERIFY(isNearly(dark, colors(dynascope::palette(ColorScheme::Dark)).warning));
    }

    void isSharpOnAFineScreen()
    {
        const QPixmap pixmap = icon(QStringLiteral("stop")).pixmap(QSize(20, 20), 2.0);
        QCOMPARE(pixmap.size(), QSize(40, 40));
        QCOMPARE(pixmap.devicePixelRatio(), 2.0);
    }

    void paintsInAnyColour()
    {
        QPixmap target(40, 40);
        target.fill(Qt::transparent);
        QPainter painter(&target);
        paintIcon(&painter, QRectF(0, 0, 40, 40), QStringLiteral("servo"), Qt::red);
        painter.end();
        QVERIFY(isNearly(ink(target).color, Qt::red));
    }

    void saysWhatIsMissing()
    {
        QTest::ignoreMessage(QtWarningMsg, "There is no icon named nonsense");
        QVERIFY(icon(QStringLiteral("nonsense")).pixmap(QSize(20, 20), 1.0).isNull());
    }

    void programHasOne() { QVERIFY(ink(applicationIcon().pixmap(QSize(64, 64), 1.0)).pixels > 2000); }
};

DYNASCOPE_UI_TEST(TestIcons)
#include "tst_icons.moc"
