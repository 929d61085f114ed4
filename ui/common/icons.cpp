// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/common/icons.h"

#include "ui/common/theme.h"

#include <QApplication>
#include <QFile>
#include <QIconEngine>
#include <QPainter>
#include <QPixmapCache>
#include <QSvgRenderer>

namespace dynascope {

namespace {

QPixmap renderIcon(const QString &name, const QColor &color, const QSize &pixels)
{
    const QString key =
        QStringLiteral("dynascope/%1/%2/%3x%4").arg(name, color.name()).arg(pixels.width()).arg(pixels.height());
    QPixmap pixmap;
    if (QPixmapCache::find(key, &pixmap))
        return pixmap;
    QFile file(QStringLiteral(":/icons/%1.svg").arg(name));
    if (!file.open(QIODevice::ReadOnly)) {
        qWarning("There is no icon named %s", qPrintable(name));
        return {};
    }
    // SVG Tiny, which Qt draws, resolves currentColor against attributes only: put the colour in itself.
    QSvgRenderer renderer(file.readAll().replace("currentColor", color.name().toLatin1()));
    pixmap = QPixmap(pixels);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    const qreal side = qMin(pixels.width(), pixels.height());
    renderer.render(&painter, QRectF((pixels.width() - side) / 2, (pixels.height() - side) / 2, side, side));
    painter.end();
    QPixmapCache::insert(key, pixmap);
    return pixmap;
}

/// Takes the colour when it is drawn: QIcon keeps nothing, so a new palette shows at the next repaint.
class TintedIconEngine : public QIconEngine
{
public:
    TintedIconEngine(QString name, IconTint tint)
        : m_name(std::move(name))
        , m_tint(tint)
    {
    }

    void paint(QPainter *painter, const QRect &rect, QIcon::Mode mode, QIcon::State) override
    {
        paintIcon(painter, rect, m_name, color(mode));
    }

    QPixmap pixmap(const QSize &size, QIcon::Mode mode, QIcon::State) override
    {
        return renderIcon(m_name, color(mode), size);
    }

    QPixmap scaledPixmap(const QSize &size, QIcon::Mode mode, QIcon::State, qreal scale) override
    {
        // Qt 6.4 asks in device pixels and sets the ratio itself.
        Q_UNUSED(scale);
        return renderIcon(m_name, color(mode), size);
    }

    QIconEngine *clone() const override { return new TintedIconEngine(*this); }
    QString key() const override { return QStringLiteral("dynascope"); }
    QString iconName() override { return m_name; }
    bool isNull() override { return false; }

private:
    QColor color(QIcon::Mode mode) const
    {
        const QPalette palette = QApplication::palette();
        switch (mode) {
        case QIcon::Disabled: return palette.color(QPalette::Disabled, QPalette::ButtonText);
        case QIcon::Selected: return palette.color(QPalette::HighlightedText);
        case QIcon::Normal:
        case QIcon::Active: break;
        }
        return tintColor(m_tint, palette);
    }

    QString m_name;
    IconTint m_tint;
};

} // namespace

QColor tintColor(IconTint tint, const QPalette &palette)
{
    const ThemeColors &theme = colors(palette);
    switch (tint) {
    case IconTint::Text: break;
    case IconTint::Dimmed: return theme.dimmed;
    case IconTint::Accent: return theme.accent;
    case IconTint::Good: return theme.good;
    case IconTint::Warning: return theme.warning;
    case IconTint::Bad: return theme.bad;
    case IconTint::White: return QColor(Qt::white);
    }
    return palette.color(QPalette::Active, QPalette::ButtonText);
}

QIcon icon(const QString &name, IconTint tint)
{
    return QIcon(new TintedIconEngine(name, tint)); // QIcon owns it
}

void paintIcon(QPainter *painter, const QRectF &rect, const QString &name, const QColor &color)
{
    const qreal ratio = painter->device() ? painter->device()->devicePixelRatioF() : 1.0;
    const QPixmap pixmap = renderIcon(name, color, (rect.size() * ratio).toSize());
    if (!pixmap.isNull())
        painter->drawPixmap(rect, pixmap, QRectF(pixmap.rect()));
}

QIcon applicationIcon()
{
    QIcon result;
    for (const int size : {16, 24, 32, 48, 64, 128, 256})
        result.addPixmap(renderIcon(QStringLiteral("dynascope"), Qt::black, QSize(size, size)));
    return result;
}

} // namespace dynascope
