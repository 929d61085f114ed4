// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/connection/portcombo.h"

#include "core/bus/networkaddress_values.h"
#include "core/session/session.h"
#include "ui/common/icons.h"
#include "ui/common/texts.h"
#include "ui/connection/connector.h"

#include <QLineEdit>
#include <QSignalBlocker>

#include <algorithm>

namespace dynascope {

PortCombo::PortCombo(PortList &ports, QWidget *parent)
    : QComboBox(parent)
    , m_ports(ports)
{
    setObjectName(QStringLiteral("portCombo"));
    setEditable(true);
    setInsertPolicy(QComboBox::NoInsert);
    setMinimumContentsLength(16);
    setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    setToolTip(
        tr("Port of the bus: choose one, or type a path, or a serial server: tcp://host:port, rfc2217://host:port "
           "(Ctrl+L)"));
    setAccessibleName(tr("Port"));
    lineEdit()->setPlaceholderText(tr("No port found"));
    connect(this, &QComboBox::editTextChanged, this, &PortCombo::portChanged);
    refresh();
}

QString PortCombo::port() const
{
    const QString text = currentText().trimmed();
    const int index = findText(text);
    return index >= 0 ? itemData(index).toString() : text;
}

void PortCombo::setPort(const QString &name)
{
    int index = findData(name);
    if (index < 0) {
        refresh();
        index = findData(name);
    }
    if (index >= 0)
        setCurrentIndex(index);
    else
        setEditText(name);
    if (!lineEdit()->hasFocus())
        lineEdit()->home(false); // of a long path the beginning is in sight
}

std::vector<PortCombo::Entry> PortCombo::entries() const
{
    std::vector<Entry> entries;
    for (const PortInfo &info : m_ports.ports()) {
        const QString tip = info.serialNumber.isEmpty()
                                ? info.description
                                : QStringLiteral("%1 (%2)").arg(info.description, info.serialNumber);
        entries.push_back({info.name, tip});
    }
    const auto isListed = [&entries](const QString &name) {
        return std::ranges::find(entries, name, &Entry::name) != entries.end();
    };
    for (const QString &name : m_open) {
        if (!isListed(name))
            entries.push_back({name, tr("Open now")});
    }
    for (const QString &name : Connector::recentPorts()) {
        if (NetworkAddress::isNetworkName(name) && !isListed(name))
            entries.push_back({name, tr("Serial server, used before")});
    }
    return entries;
}

void PortCombo::setOpenPorts(const QStringList &names)
{
    if (names == m_open)
        return;
    m_open = names;
    refresh();
}

/// Entry by entry: an open list stays open, and what is being typed stays as it is.
void PortCombo::refresh()
{
    const QString before = port();
    const QString typed = currentText();
    const int cursor = lineEdit()->cursorPosition();
    {
        const QSignalBlocker blocker(this);
        const std::vector<Entry> wanted = entries();
        for (int at = count() - 1; at >= 0; --at) {
            if (std::ranges::find(wanted, itemData(at).toString(), &Entry::name) == wanted.end())
                removeItem(at);
        }
        for (int at = 0; at < static_cast<int>(wanted.size()); ++at)
            place(wanted[static_cast<std::size_t>(at)], at);
        const int index = findData(before);
        if (index >= 0) {
            setCurrentIndex(index);
        } else if (!before.isEmpty()) {
            setEditText(typed);
            lineEdit()->setCursorPosition(cursor);
        }
    }
    if (port() != before)
        emit portChanged();
}

void PortCombo::place(const Entry &entry, int at)
{
    if (itemData(at).toString() != entry.name) {
        if (const int elsewhere = findData(entry.name); elsewhere >= 0)
            removeItem(elsewhere);
        const bool simulated = entry.name == QStringLiteral("sim");
        insertItem(at, icon(simulated ? QStringLiteral("servo") : QStringLiteral("plug")), portText(entry.name),
                   entry.name);
    }
    setItemData(at, plainToolTip(entry.tip), Qt::ToolTipRole);
}

void PortCombo::showPopup()
{
    refresh();
    QComboBox::showPopup();
}

} // namespace dynascope
