// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/welcomepage.h"

#include "ui/common/icons.h"
#include "ui/common/texts.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

#include <algorithm>
#include <chrono>

namespace dynascope {

namespace {

using namespace std::chrono_literals;

constexpr auto LookInterval = 2s;
constexpr std::size_t MostPorts = 5;
constexpr int ButtonWidth = 420;

bool isSimulated(const PortInfo &port)
{
    return port.name == QStringLiteral("sim");
}

} // namespace

WelcomePage::WelcomePage(PortList &ports, QWidget *parent)
    : QWidget(parent)
    , m_ports(ports)
    , m_portButtons(new QVBoxLayout)
    , m_hint(new QLabel(this))
{
    setObjectName(QStringLiteral("welcomePage"));
    setBackgroundRole(QPalette::Base);
    setAutoFillBackground(true);

    auto *picture = new QLabel(this);
    picture->setPixmap(applicationIcon().pixmap(QSize(64, 64), devicePixelRatioF()));
    auto *title = new QLabel(tr("Dynascope"), this);
    QFont large = title->font();
    large.setPointSizeF(large.pointSizeF() * 2);
    large.setWeight(QFont::DemiBold);
    title->setFont(large);
    auto *subtitle = new QLabel(tr("Find DYNAMIXEL servos, set them up without fear, watch them move."), this);
    subtitle->setForegroundRole(QPalette::PlaceholderText);
    subtitle->setWordWrap(true);
    m_hint->setObjectName(QStringLiteral("welcomeHint"));
    m_hint->setForegroundRole(QPalette::PlaceholderText);
    m_hint->setWordWrap(true);

    m_connect = makeButton(QStringLiteral("welcomeConnect"), QStringLiteral("connect"), tr("Connect a port…"));
    m_connect->setToolTip(tr("Choose from the ports there are, or type a path (Ctrl+L)"));
    connect(m_connect, &QPushButton::clicked, this, &WelcomePage::choosePortRequested);
    m_simulate = makeButton(QStringLiteral("welcomeSimulate"), QStringLiteral("servo"), tr("Try the simulated bus"));
    m_simulate->setToolTip(tr("A small arm of six servos and a fresh one, without any hardware"));
    connect(m_simulate, &QPushButton::clicked, this, [this] { emit connectRequested(QStringLiteral("sim")); });

    QPushButton *library =
        makeButton(QStringLiteral("welcomeLibrary"), QStringLiteral("search"), tr("Look up control tables"));
    library->setToolTip(tr("The registers of any model, without the device (Ctrl+Shift+L)"));
    connect(library, &QPushButton::clicked, this, &WelcomePage::libraryRequested);

    setFocusProxy(m_connect);

    auto *column = new QVBoxLayout;
    column->setSpacing(8);
    column->addStretch(2);
    column->addWidget(picture);
    column->addWidget(title);
    column->addWidget(subtitle);
    column->addSpacing(24);
    m_portButtons->setSpacing(8);
    column->addLayout(m_portButtons);
    column->addWidget(m_connect);
    column->addWidget(m_simulate);
    column->addWidget(library);
    column->addSpacing(8);
    column->addWidget(m_hint);
    column->addStretch(3);
    auto *layout = new QHBoxLayout(this);
    layout->addStretch(1);
    layout->addLayout(column);
    layout->addStretch(1);

    m_timer.setInterval(LookInterval);
    connect(&m_timer, &QTimer::timeout, this, &WelcomePage::refresh);
    refresh();
}

QPushButton *WelcomePage::makeButton(const QString &name, const QString &iconName, const QString &text)
{
    auto *button = new QPushButton(icon(iconName, IconTint::Accent), text, this);
    button->setObjectName(name);
    button->setMinimumSize(ButtonWidth, 44);
    button->setIconSize(QSize(20, 20));
    return button;
}

void WelcomePage::refresh()
{
    std::vector<PortInfo> all = m_ports.ports();
    m_simulate->setVisible(std::ranges::any_of(all, isSimulated));
    std::erase_if(all, isSimulated);
    m_hint->setText(all.empty()
            ? tr("No serial port was found. Plug in the adapter (U2D2 or another), and it appears here.")
            : tr("A port that can't be opened for lack of permission: become a member of the group dialout, "
                 "then log in again."));
    if (all.size() > MostPorts)
        all.resize(MostPorts);
    if (all == m_shown)
        return;
    m_shown = all;
    while (QLayoutItem *item = m_portButtons->takeAt(0)) {
        item->widget()->deleteLater();
        delete item;
    }
    for (const PortInfo &port : m_shown) {
        const QString text =
            port.description.isEmpty() ? port.name : QStringLiteral("%1   %2").arg(port.name, port.description);
        QPushButton *button = makeButton(QStringLiteral("welcomePort"), QStringLiteral("plug"), QString());
        button->setText(plainLabel(button->fontMetrics().elidedText(text, Qt::ElideMiddle, ButtonWidth - 60)));
        button->setToolTip(plainToolTip(tr("Connect to %1").arg(text)));
        connect(button, &QPushButton::clicked, this, [this, name = port.name] { emit connectRequested(name); });
        m_portButtons->addWidget(button);
    }
}

void WelcomePage::showEvent(QShowEvent *event)
{
    refresh();
    m_timer.start();
    QWidget::showEvent(event);
}

void WelcomePage::hideEvent(QHideEvent *event)
{
    m_timer.stop();
    QWidget::hideEvent(event);
}

} // namespace dynascope
