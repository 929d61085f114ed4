// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/common/theme.h"

#include "ui/common/flatstyle.h"

#include <QApplication>
#include <QFontDatabase>
#include <QFontMetricsF>
#include <QSettings>
#include <QToolTip>

#include <array>
#include <cmath>

namespace dynascope {

namespace {

const QString SchemeKey = QStringLiteral("window/scheme");
const QString LightName = QStringLiteral("light");
const QString DarkName = QStringLiteral("dark");

/// The colours one palette is made of.
struct Tones {
    QRgb window, base, alternate, text, button, highlight, highlightedText, link, placeholder, disabled;
    QRgb light, midlight, mid, dark, shadow, tip;
};

constexpr Tones LightTones{
    .window = 0xFFF4F5F7,
    .base = 0xFFFFFFFF,
    .alternate = 0xFFF8F9FB,
    .text = 0xFF1D2229,
    .button = 0xFFFFFFFF,
    .highlight = 0xFF0B62C4,
    .highlightedText = 0xFFFFFFFF,
    .link = 0xFF0B62C4,
    .placeholder = 0xFF67707C,
    .disabled = 0xFF98A0AB,
    .light = 0xFFFFFFFF,
    .midlight = 0xFFEEF0F3,
    .mid = 0xFFC9CED6,
    .dark = 0xFFA9B0BA,
    .shadow = 0xFF6F7782,
    .tip = 0xFFFFFFFF,
};
constexpr Tones DarkTones{
    .window = 0xFF20242A,
    .base = 0xFF191C21,
    .alternate = 0xFF1D2126,
    .text = 0xFFE4E7EB,
    .button = 0xFF2B3037,
    .highlight = 0xFF2A69C7,
    .highlightedText = 0xFFFFFFFF,
    .link = 0xFF7DB4FF,
    .placeholder = 0xFF98A1AD,
    .disabled = 0xFF6A737F,
    .light = 0xFF3A4149,
    .midlight = 0xFF30363D,
    .mid = 0xFF454C56,
    .dark = 0xFF15181C,
    .shadow = 0xFF0C0E11,
    .tip = 0xFF2E343C,
};

QPalette paletteOf(const Tones &tones)
{
    QPalette palette;
    const auto set = [&palette](QPalette::ColorRole role, QRgb color) {
        palette.setColor(role, QColor::fromRgb(color));
    };
    set(QPalette::Window, tones.window);
    set(QPalette::WindowText, tones.text);
    set(QPalette::Base, tones.base);
    set(QPalette::AlternateBase, tones.alternate);
    set(QPalette::Text, tones.text);
    set(QPalette::Button, tones.button);
    set(QPalette::ButtonText, tones.text);
    set(QPalette::BrightText, tones.highlightedText);
    set(QPalette::Highlight, tones.highlight);
    set(QPalette::HighlightedText, tones.highlightedText);
    set(QPalette::Link, tones.link);
    set(QPalette::LinkVisited, tones.link);
    set(QPalette::PlaceholderText, tones.placeholder);
    set(QPalette::ToolTipBase, tones.tip);
    set(QPalette::ToolTipText, tones.text);
    set(QPalette::Light, tones.light);
    set(QPalette::Midlight, tones.midlight);
    set(QPalette::Mid, tones.mid);
    set(QPalette::Dark, tones.dark);
    set(QPalette::Shadow, tones.shadow);
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::HighlightedText})
        palette.setColor(QPalette::Disabled, role, QColor::fromRgb(tones.disabled));
    palette.setColor(QPalette::Disabled, QPalette::Highlight, QColor::fromRgb(tones.mid));
    palette.setColor(QPalette::Disabled, QPalette::Base, QColor::fromRgb(tones.window));
    palette.setColor(QPalette::Disabled, QPalette::Button, QColor::fromRgb(tones.window));
    return palette;
}

ThemeColors makeColors(bool dark)
{
    ThemeColors result;
    result.dark = dark;
    result.accent = QColor(dark ? 0xFF7DB4FF : 0xFF0B62C4);
    result.good = QColor(dark ? 0xFF56C98F : 0xFF157539);
    result.warning = QColor(dark ? 0xFFE9B44C : 0xFF8A5700);
    result.bad = QColor(dark ? 0xFFFF8A80 : 0xFFBC1C22);
    result.dimmed = QColor(dark ? 0xFF9DA6B2 : 0xFF5C6570);
    result.grid = QColor(dark ? 0xFF30363E : 0xFFE3E6EA);
    result.changed = QColor(dark ? 0xFF4A3F18 : 0xFFFFEFB3);
    result.border = QColor(dark ? 0xFF3A414A : 0xFFD3D8DE);
    result.header = QColor(dark ? 0xFF252A31 : 0xFFEDEFF2);
    return result;
}

bool isDark(const QPalette &palette)
{
    return palette.color(QPalette::Active, QPalette::Base).lightness()
        < palette.color(QPalette::Active, QPalette::Text).lightness();
}

double channel(double value)
{
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double luminance(const QColor &color)
{
    return 0.2126 * channel(color.redF()) + 0.7152 * channel(color.greenF()) + 0.0722 * channel(color.blueF());
}

constexpr std::size_t HueCount = 8;
constexpr std::size_t RoundCount = 3; ///< a hue comes again darker or lighter before all begin anew

using TraceTable = std::array<QColor, HueCount * RoundCount>;

/// Moves the lightness away from the background until a thin line shows on it (WCAG 1.4.11 asks for 3:1; on a dark
/// ground a thin line needs more).
QColor readable(QColor color, const QColor &background, bool dark)
{
    for (int i = 0; i < 60 && contrastRatio(color, background) < (dark ? 4.5 : 3.0); ++i) {
        const float lightness = color.lightnessF() + (dark ? 0.02F : -0.02F);
        color = QColor::fromHslF(color.hslHueF(), color.hslSaturationF(), qBound(0.0F, lightness, 1.0F));
    }
    return color;
}

TraceTable makeTraces(bool dark)
{
    // Okabe & Ito 2008: told apart also with a colour-vision deficiency. The last stands for their black.
    const std::array<QRgb, HueCount> hues{0xFF0072B2, 0xFFD55E00, 0xFF009E73, 0xFFCC79A7,
                                          0xFFE69F00, 0xFF56B4E9, 0xFFF0E442, dark ? 0xFFE4E7EB : 0xFF1D2229};
    const QColor background = QColor::fromRgb(dark ? DarkTones.base : LightTones.base);
    TraceTable traces;
    for (std::size_t i = 0; i < traces.size(); ++i) {
        QColor color = readable(QColor::fromRgb(hues[i % HueCount]), background, dark);
        const auto round = static_cast<int>(i / HueCount);
        if (round > 0)
            color = dark ? color.lighter(100 + 22 * round) : color.darker(100 + 35 * round);
        if (round > 0 && i % HueCount == HueCount - 1)
            color = QColor::fromRgb(round == 1 ? 0xFF7C8591 : (dark ? 0xFFB4BCC6 : 0xFF4C545E));
        traces[i] = color;
    }
    return traces;
}

bool hasEqualDigits(const QFont &font)
{
    const QFontMetricsF metrics(font);
    const qreal width = metrics.horizontalAdvance(u'0');
    for (char16_t digit = u'1'; digit <= u'9'; ++digit) {
        if (std::abs(metrics.horizontalAdvance(QChar(digit)) - width) > 0.01)
            return false;
    }
    return true;
}

} // namespace

QPalette palette(ColorScheme scheme)
{
    static const bool systemIsDark = isDark(QApplication::palette());
    const bool dark = scheme == ColorScheme::Dark || (scheme == ColorScheme::System && systemIsDark);
    return paletteOf(dark ? DarkTones : LightTones);
}

void applyTheme(QApplication &application, ColorScheme scheme)
{
    const QPalette chosen = palette(scheme); // before the style, which may bring a palette of its own
    if (!qobject_cast<FlatStyle *>(application.style()))
        application.setStyle(new FlatStyle); // the application owns it
    application.setPalette(chosen);
    QToolTip::setPalette(chosen);
}

ColorScheme savedColorScheme()
{
    const QString saved = QSettings().value(SchemeKey).toString();
    if (saved == LightName)
        return ColorScheme::Light;
    return saved == DarkName ? ColorScheme::Dark : ColorScheme::System;
}

void saveColorScheme(ColorScheme scheme)
{
    QSettings().setValue(SchemeKey, scheme == ColorScheme::Light ? LightName
                             : scheme == ColorScheme::Dark       ? DarkName
                                                                 : QStringLiteral("system"));
}

const ThemeColors &colors(const QPalette &palette)
{
    static const ThemeColors light = makeColors(false);
    static const ThemeColors dark = makeColors(true);
    return isDark(palette) ? dark : light;
}

QColor traceColor(int index, const QPalette &palette)
{
    static const TraceTable light = makeTraces(false);
    static const TraceTable dark = makeTraces(true);
    const TraceTable &table = isDark(palette) ? dark : light;
    return table[static_cast<std::size_t>(qMax(0, index)) % table.size()];
}

double contrastRatio(const QColor &one, const QColor &other)
{
    const double a = luminance(one);
    const double b = luminance(other);
    return (qMax(a, b) + 0.05) / (qMin(a, b) + 0.05);
}

QFont boldened(QFont font)
{
    font.setBold(true);
    return font;
}

QFont numberFont(const QFont &base)
{
    if (hasEqualDigits(base))
        return base;
    QFont fixed = QFontDatabase::systemFont(QFontDatabase::FixedFont);
    if (base.pixelSize() > 0)
        fixed.setPixelSize(base.pixelSize());
    else
        fixed.setPointSizeF(base.pointSizeF());
    fixed.setWeight(base.weight());
    return fixed;
}

} // namespace dynascope
