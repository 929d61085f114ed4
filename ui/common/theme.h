// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QFont>
#include <QPalette>

class QApplication;

namespace dynascope {

enum class ColorScheme { System, Light, Dark };

/// Colours with a meaning. Never the only carrier of it.
struct ThemeColors {
    bool dark = false;
    QColor accent, good, warning, bad, dimmed, grid, changed; ///< `changed`: background of a value that just changed
    QColor border, header;
};

/// Fusion with our own light or dark palette. The system's own choice is read once, at the first call.
void applyTheme(QApplication &application, ColorScheme scheme);
QPalette palette(ColorScheme scheme);
/// What a person chose last; System where nobody did.
ColorScheme savedColorScheme();
void saveColorScheme(ColorScheme scheme);
/// Those that go with a palette made here. Cheap: may be called while painting.
const ThemeColors &colors(const QPalette &palette);

/// Okabe-Ito first; `index` is the trace's own, so a trace keeps its colour.
QColor traceColor(int index, const QPalette &palette);

/// WCAG 2: 1 (the same) to 21 (black on white).
double contrastRatio(const QColor &one, const QColor &other);

/// The UI font if its ten digits are of one width, else the system's fixed font at the same size.
QFont numberFont(const QFont &base);
QFont boldened(QFont font);

} // namespace dynascope
