// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/connection/portcombo.h"

#include "core/session/session.h"
#include "ui/common/icons.h"
#include "ui/common/texts.h"

#include <QLineEdit>
#include <QSignalBlocker>

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
    setToolTip(tr("Port of the bus: choose one, or type a path (Ctrl+L)"));
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
}

void PortCombo::refresh()
{
    const QString before = port();
    {
        const QSignalBlocker blocker(this);
        clear();
        for (const PortInfo &info : m_ports.ports()) {
            const bool simulated = info.name == QStringLiteral("sim");
            const QString text = portText(info.name);
            addItem(icon(simulated ? QStringLiteral("servo") : QStringLiteral("plug")), text, info.name);
            QString tip = info.description;
            if (!info.serialNumber.isEmpty())
                tip += QStringLiteral(" (%1)").arg(info.serialNumber);
            setItemData(count() - 1, tip, Qt::ToolTipRole);
        }
        const int index = findData(before);
        if (index >= 0)
            setCurrentIndex(index);
        else if (!before.isEmpty())
            setEditText(before);
    }
    if (port() != before)
        emit portChanged();
}

void PortCombo::showPopup()
{
    refresh();
    QComboBox::showPopup();
}

} // namespace dynascope
