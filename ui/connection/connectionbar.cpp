// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/connection/connectionbar.h"

#include "core/bus/networkaddress_values.h"
#include "core/session/commands.h"
#include "core/session/scanner.h"
#include "ui/common/elidedlabel.h"
#include "ui/common/icons.h"
#include "ui/common/texts.h"
#include "ui/connection/baudcombo.h"
#include "ui/connection/connector.h"
#include "ui/connection/portcombo.h"
#include "ui/connection/scanoptions.h"
#include "ui/connection/stopbutton.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QStackedWidget>
#include <QToolButton>

namespace dynascope {

ConnectionBar::ConnectionBar(const Workbench &workbench, Connector &connector, QWidget *parent)
    : QToolBar(tr("Connection"), parent)
    , m_workbench(workbench)
    , m_connector(connector)
    , m_port(new PortCombo(workbench.ports, this))
    , m_rate(new QStackedWidget(this))
    , m_baud(new BaudCombo(this))
    , m_connect(new QPushButton(this))
    , m_disconnect(new QToolButton(this))
    , m_scan(new QPushButton(this))
    , m_scanMore(new QToolButton(this))
    , m_status(new QStackedWidget(this))
    , m_state(new ElidedLabel(this))
    , m_stateIcon(new QLabel(this))
    , m_progress(new QProgressBar(this))
    , m_progressText(new QLabel(this))
    , m_cancel(new QToolButton(this))
    , m_options(new ScanOptions(this))
    , m_stop(new StopButton(workbench.stop, this))
{
    setObjectName(QStringLiteral("connectionBar"));
    setMovable(false);
    setFloatable(false);
    setContextMenuPolicy(Qt::PreventContextMenu); // it can't be hidden: STOP is here
    makeButtons();
    addAll();

    connect(m_port, &PortCombo::portChanged, this, &ConnectionBar::update);
    const auto showUsualBaud = [this] {
        if (!currentLine())
            m_baud->setBaudRate(Connector::lastBaudRate(m_port->port()));
    };
    connect(m_port, &QComboBox::activated, this, [this, showUsualBaud] {
        m_isBaudByHand = false;
        showUsualBaud();
    });
    // Typed: 57 600 bps is not what the simulated bus works at, nor the other way round.
    connect(m_port->lineEdit(), &QLineEdit::textEdited, this, [this, showUsualBaud] {
        if (!m_isBaudByHand)
            showUsualBaud();
    });
    const auto chosenByHand = [this] { m_isBaudByHand = true; };
    connect(m_baud, &QComboBox::activated, this, chosenByHand);
    connect(m_baud->lineEdit(), &QLineEdit::textEdited, this, chosenByHand);
    showUsualBaud();
    connect(m_port->lineEdit(), &QLineEdit::returnPressed, this, [this] {
        if (!currentLine())
            toggleConnection();
    });
    connect(m_baud, &BaudCombo::baudRateChosen, this, &ConnectionBar::onBaudChosen);
    connect(m_baud, &QComboBox::editTextChanged, this, &ConnectionBar::update);
    connect(m_connect, &QPushButton::clicked, this, &ConnectionBar::toggleConnection);
    connect(m_disconnect, &QToolButton::clicked, this, &ConnectionBar::disconnectLine);
    connect(m_scan, &QPushButton::clicked, this, &ConnectionBar::startScan);
    connect(m_scanMore, &QToolButton::clicked, this, &ConnectionBar::showScanOptions);
    connect(m_cancel, &QToolButton::clicked, &connector, &Connector::cancelScan);
    connect(m_options, &ScanOptions::scanRequested, this, &ConnectionBar::startScan);
    connect(&connector, &Connector::changed, this, &ConnectionBar::update);
    connect(&connector, &Connector::portsChanged, m_port, &PortCombo::refresh);
    connect(&connector, &Connector::moved, this, &ConnectionBar::onMoved);
    connect(&workbench.scanner, &Scanner::progressChanged, this, &ConnectionBar::updateScan);
    connect(&workbench.scanner, &Scanner::finished, this, &ConnectionBar::updateScan);
    update();
    updateScan();
}

void ConnectionBar::makeButtons()
{
    m_connect->setObjectName(QStringLiteral("connectButton"));
    m_disconnect->setObjectName(QStringLiteral("disconnectButton"));
    m_disconnect->setIcon(icon(QStringLiteral("disconnect")));
    m_disconnect->setAutoRaise(false);
    m_disconnect->setToolTip(tr("Disconnect: give this port up, and forget its devices"));
    m_disconnect->setAccessibleName(tr("Disconnect"));
    m_scan->setObjectName(QStringLiteral("scanButton"));
    m_scan->setText(tr("Scan"));
    m_scan->setIcon(icon(QStringLiteral("scan")));
    m_scan->setToolTip(tr("Look for devices at the likely baud rates (Ctrl+R); the arrow chooses rates and IDs"));
    m_scanMore->setObjectName(QStringLiteral("scanOptionsButton"));
    m_scanMore->setIcon(icon(QStringLiteral("chevron-down")));
    m_scanMore->setIconSize(QSize(14, 14));
    m_scanMore->setAutoRaise(false); // a child of a tool bar begins raised
    m_scanMore->setToolTip(tr("Choose baud rates and IDs to scan (Ctrl+Shift+R)"));
    m_scanMore->setAccessibleName(tr("Scan options"));

    m_progress->setObjectName(QStringLiteral("scanProgress"));
    m_progress->setRange(0, 1000);
    m_progress->setTextVisible(false);
    m_progress->setFixedHeight(6);
    m_progress->setMinimumWidth(60);
    m_progress->setAccessibleName(tr("Scan progress"));
    m_cancel->setObjectName(QStringLiteral("scanCancel"));
    m_cancel->setIcon(icon(QStringLiteral("close")));
    m_cancel->setAutoRaise(true);
    m_cancel->setToolTip(tr("Cancel the scan; what was found stays"));
    m_cancel->setAccessibleName(tr("Cancel scan"));
    m_state->setObjectName(QStringLiteral("connectionState"));
}

void ConnectionBar::addAll()
{
    auto *state = new QWidget(m_status);
    auto *stateLayout = new QHBoxLayout(state);
    stateLayout->setContentsMargins(8, 0, 8, 0);
    stateLayout->setSpacing(6);
    stateLayout->addWidget(m_stateIcon);
    stateLayout->addWidget(m_state, 1);
    auto *scanning = new QWidget(m_status);
    auto *scanLayout = new QHBoxLayout(scanning);
    scanLayout->setContentsMargins(8, 0, 8, 0);
    scanLayout->setSpacing(8);
    scanLayout->addWidget(m_progress, 1);
    scanLayout->addWidget(m_progressText, 2);
    scanLayout->addWidget(m_cancel);
    m_status->addWidget(state);
    m_status->addWidget(scanning);
    m_status->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);

    auto *content = new QWidget(this);
    auto *layout = new QHBoxLayout(content);
    layout->setContentsMargins(8, 6, 8, 6);
    layout->setSpacing(8);
    m_port->setMinimumWidth(150);
    m_port->setMaximumWidth(260);
    layout->addWidget(m_port, 1);
    auto *servers = new QLabel(tr("Rate is the server's"), m_rate);
    servers->setObjectName(QStringLiteral("serversRate"));
    servers->setToolTip(
        tr("A raw TCP connection can't set it. Through rfc2217:// it can be, where the server offers that."));
    m_rate->addWidget(m_baud);
    m_rate->addWidget(servers);
    m_rate->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    layout->addWidget(m_rate);
    layout->addWidget(m_connect);
    layout->addWidget(m_disconnect);
    auto *scan = new QHBoxLayout;
    scan->setSpacing(2);
    scan->addWidget(m_scan);
    scan->addWidget(m_scanMore);
    layout->addLayout(scan);
    layout->addWidget(m_status, 2);
    layout->addWidget(m_stop);
    for (QWidget *widget : {static_cast<QWidget *>(m_port), static_cast<QWidget *>(m_baud),
                            static_cast<QWidget *>(m_connect), static_cast<QWidget *>(m_disconnect),
                            static_cast<QWidget *>(m_scan), static_cast<QWidget *>(m_scanMore)})
        widget->setFixedHeight(32);
    content->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    addWidget(content);
}

LineSession *ConnectionBar::currentLine() const
{
    return m_connector.line(m_port->port());
}

void ConnectionBar::setPort(const QString &port, int baudRate)
{
    m_port->setPort(port);
    if (baudRate > 0)
        m_baud->setBaudRate(baudRate);
}

void ConnectionBar::showLine(LineSession &line)
{
    const bool typing = m_port->lineEdit()->hasFocus() && m_port->lineEdit()->isModified();
    if (!typing && currentLine() != &line)
        setPort(line.name(), line.baudRate());
}

QWidget *ConnectionBar::stopButton() const
{
    return m_stop;
}

void ConnectionBar::choosePort()
{
    m_port->lineEdit()->setFocus(Qt::ShortcutFocusReason);
    m_port->lineEdit()->selectAll();
}

void ConnectionBar::showPorts()
{
    m_port->setFocus(Qt::ShortcutFocusReason);
    m_port->showPopup();
}

void ConnectionBar::toggleConnection()
{
    LineSession *line = currentLine();
    if (!line)
        m_connector.connectTo(m_port->port(), m_baud->baudRate());
    else if (line->state() == BusThread::State::Lost || line->state() == BusThread::State::Closed)
        m_connector.reconnect(*line);
    else
        m_connector.disconnectFrom(*line);
}

void ConnectionBar::disconnectLine()
{
    if (LineSession *line = currentLine())
        m_connector.disconnectFrom(*line);
}

void ConnectionBar::startScan()
{
    if (LineSession *line = currentLine())
        m_connector.scan(*line, m_options->range(line->baudRate()));
}

void ConnectionBar::showScanOptions()
{
    m_options->popup(m_scan->mapToGlobal(QPoint(0, m_scan->height() + 4)));
}

void ConnectionBar::onBaudChosen(int bitsPerSecond)
{
    LineSession *line = currentLine();
    if (!line || line->state() != BusThread::State::Open || bitsPerSecond <= 0 || bitsPerSecond == line->baudRate())
        return;
    m_workbench.commands.workAtBaud(
        *line, bitsPerSecond, [here = QPointer<ConnectionBar>(this)](const Result<void> &result) {
            if (!result && here && here->currentLine())
                here->m_baud->setBaudRate(here->currentLine()->baudRate());
        });
}

void ConnectionBar::onMoved(const QString &formerPort, const QString &port)
{
    if (m_port->port() == formerPort)
        m_port->setPort(port);
}

void ConnectionBar::update()
{
    QStringList names;
    for (const auto &each : m_workbench.session.lines())
        names << each->name();
    m_port->setOpenPorts(names);
    LineSession *line = currentLine();
    const auto state = line ? line->state() : BusThread::State::Closed;
    const bool open = line && state == BusThread::State::Open;
    const bool broken = line && (state == BusThread::State::Lost || state == BusThread::State::Closed);
    const bool valid = !m_port->port().isEmpty() && m_baud->baudRate() > 0;

    const bool serversRate = isRateTheServers(m_port->port());
    m_rate->setCurrentIndex(serversRate ? 1 : 0);
    m_options->setRatesOffered(!serversRate);
    m_connect->setText(!line ? tr("Connect") : broken ? tr("Reconnect") : tr("Disconnect"));
    m_connect->setIcon(icon(!line || broken ? QStringLiteral("connect") : QStringLiteral("disconnect")));
    m_connect->setEnabled(line || valid);
    m_disconnect->setVisible(broken);
    m_connect->setToolTip(!line    ? tr("Open this port and look for devices (Ctrl+Return)")
                          : broken ? tr("Open this port again; its devices are kept (Ctrl+Return)")
                                   : tr("Close this port. Torque stays as it is. (Ctrl+Return)"));
    m_scan->setEnabled(open && !m_workbench.scanner.isRunning());
    m_scanMore->setEnabled(m_scan->isEnabled());

    const QString icons = open ? QStringLiteral("success") : broken ? QStringLiteral("error") : QStringLiteral("plug");
    const IconTint tint = open ? IconTint::Good : broken ? IconTint::Bad : IconTint::Dimmed;
    m_stateIcon->setPixmap(icon(icons, tint).pixmap(QSize(16, 16), devicePixelRatioF()));
    m_state->setText(stateText(line));

    if (open && (line != m_shown || line->baudRate() != m_shownBaud)) {
        m_shownBaud = line->baudRate();
        m_baud->setBaudRate(m_shownBaud);
    }
    m_shown = open ? line : nullptr;
    emit currentLineChanged();
}

/// Of the port that is chosen; where that isn't open, which ones are.
QString ConnectionBar::stateText(const LineSession *line) const
{
    if (line)
        return lineStateText(*line);
    QStringList open;
    for (const auto &other : m_workbench.session.lines()) {
        if (other->state() == BusThread::State::Open)
            open << portText(other->name());
    }
    if (!open.isEmpty())
        return tr("Not connected; open is %1").arg(open.join(QStringLiteral(", ")));
    return m_port->port().isEmpty() ? tr("Choose a port") : tr("Not connected");
}

void ConnectionBar::changeEvent(QEvent *event)
{
    if (event->type() == QEvent::PaletteChange)
        update(); // a label keeps its picture
    QToolBar::changeEvent(event);
}

void ConnectionBar::updateScan()
{
    const Scanner &scanner = m_workbench.scanner;
    const bool running = scanner.isRunning();
    m_status->setCurrentIndex(running ? 1 : 0);
    m_scan->setEnabled(!running && currentLine() && currentLine()->state() == BusThread::State::Open);
    m_scanMore->setEnabled(m_scan->isEnabled());
    if (!running)
        return;
    m_progress->setValue(qRound(scanner.progress() * 1000));
    const LineSession *line = m_connector.scannedLine();
    const QString rate =
        line && isRateTheServers(line->name()) ? tr("the server's rate") : baudText(scanner.currentBaud());
    m_progressText->setText(tr("%1, %n found", nullptr, scanner.found()).arg(rate));
    m_progressText->setToolTip(tr("Scanning at %1").arg(rate));
}

} // namespace dynascope
