// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "ui/common/watchmime.h"

#include <QFontMetricsF>
#include <QImage>
#include <QPainter>
#include <QStyleOption>

using namespace dynascope;

class TestTheme : public QObject
{
    Q_OBJECT

private slots:
    void contrastIsThatOfWcag()
    {
        QCOMPARE(contrastRatio(Qt::black, Qt::white), 21.0);
        QCOMPARE(contrastRatio(Qt::white, Qt::white), 1.0);
        QVERIFY(qAbs(contrastRatio(QColor(0x76, 0x76, 0x76), Qt::white) - 4.54) < 0.01);
    }

    void textIsReadable_data()
    {
        QTest::addColumn<QColor>("text");
        QTest::addColumn<QColor>("background");
        for (const ColorScheme scheme : {ColorScheme::Light, ColorScheme::Dark}) {
            const QPalette palette = dynascope::palette(scheme);
            const ThemeColors &theme = colors(palette);
            const QByteArray name = scheme == ColorScheme::Dark ? "dark" : "light";
            const auto row = [&name](const char *what, const QColor &text, const QColor &background) {
                QTest::newRow((name + ", " + what).constData()) << text << background;
            };
            const QColor window = palette.color(QPalette::Window);
            const QColor base = palette.color(QPalette::Base);
            row("window text", palette.color(QPalette::WindowText), window);
            row("text", palette.color(QPalette::Text), base);
            row("text on alternate rows", palette.color(QPalette::Text), palette.color(QPalette::AlternateBase));
            row("placeholder", palette.color(QPalette::PlaceholderText), base);
            row("button text", palette.color(QPalette::ButtonText), palette.color(QPalette::Button));
            row("selected", palette.color(QPalette::HighlightedText), palette.color(QPalette::Highlight));
            row("tool tip", palette.color(QPalette::ToolTipText), palette.color(QPalette::ToolTipBase));
            row("link", palette.color(QPalette::Link), base);
            row("accent", theme.accent, base);
            row("good", theme.good, base);
            row("good on window", theme.good, window);
            row("warning", theme.warning, base);
            row("warning on window", theme.warning, window);
            row("bad", theme.bad, base);
            row("bad on window", theme.bad, window);
            row("dimmed", theme.dimmed, base);
            row("dimmed on window", theme.dimmed, window);
            row("header", palette.color(QPalette::Text), theme.header);
            row("dimmed on header", theme.dimmed, theme.header);
            row("changed", palette.color(QPalette::Text), theme.changed);
        }
    }

    void textIsReadable()
    {
        QFETCH(QColor, text);
        QFETCH(QColor, background);
        const double ratio = contrastRatio(text, background);
        QVERIFY2(ratio >= 4.5, qPrintable(QString::number(ratio)));
    }

    void tracesShowAndDiffer()
    {
        for (const ColorScheme scheme : {ColorScheme::Light, ColorScheme::Dark}) {
            const QPalette palette = dynascope::palette(scheme);
            QList<QColor> seen;
            for (int i = 0; i < 24; ++i) {
                const QColor color = traceColor(i, palette);
                QVERIFY2(contrastRatio(color, palette.color(QPalette::Base)) >= 2.95, qPrintable(color.name()));
                QVERIFY2(!seen.contains(color), qPrintable(color.name()));
                seen.append(color);
            }
            QCOMPARE(traceColor(24, palette), seen.first());
        }
    }

    void arrowOfASelectedRowIsReadable()
    {
        QStyleOption option;
        option.rect = QRect(0, 0, 20, 20);
        option.state = QStyle::State_Enabled | QStyle::State_Children | QStyle::State_Selected;
        option.palette = dynascope::palette(ColorScheme::Light);
        const QColor ground = option.palette.color(QPalette::Highlight);
        QImage image(option.rect.size(), QImage::Format_RGB32);
        image.fill(ground);
        QPainter painter(&image);
        QApplication::style()->drawPrimitive(QStyle::PE_IndicatorBranch, &option, &painter);
        painter.end();
        double best = 0;
        for (int at = 0; at < image.width() * image.height(); ++at)
            best = std::max(best, contrastRatio(image.pixelColor(at % image.width(), at / image.width()), ground));
        QVERIFY2(best >= 3, qPrintable(QString::number(best)));
    }

    void schemesDiffer()
    {
        QVERIFY(!colors(dynascope::palette(ColorScheme::Light)).dark);
        QVERIFY(colors(dynascope::palette(ColorScheme::Dark)).dark);
    }

    void digitsHaveOneWidth()
    {
        const QFont base = QApplication::font();
        const QFont font = numberFont(base);
        const QFontMetricsF metrics(font);
        for (char16_t digit = u'0'; digit <= u'9'; ++digit)
            QCOMPARE(metrics.horizontalAdvance(QChar(digit)), metrics.horizontalAdvance(u'0'));
        QCOMPARE(font.pointSizeF(), base.pointSizeF());
    }

    void watchesTravel()
    {
        const std::vector<Watch> watches{{1, 2}, {7, 40}};
        const auto mime = watchesToMime(watches);
        QVERIFY(watchesFromMime(mime.get()) == watches);
        QVERIFY(watchesFromMime(nullptr).empty());

        const QString type = QString::fromLatin1(WatchMimeType);
        const QByteArray whole = mime->data(type);
        for (qsizetype length = 0; length < whole.size(); ++length) {
            QMimeData damaged;
            damaged.setData(type, whole.first(length));
            QVERIFY(watchesFromMime(&damaged).empty());
        }
        QMimeData longer;
        longer.setData(type, whole + "x");
        QVERIFY(watchesFromMime(&longer).empty());
    }
};

DYNASCOPE_UI_TEST(TestTheme)
#include "tst_theme.moc"
