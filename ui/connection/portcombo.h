// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QComboBox>

#include <vector>

namespace dynascope {

class PortList;

/// The ports there are, those that are open, and the serial servers used before; any other path or address can be typed. refresh() brings it
/// up to date, also while it is open; opening it does.
class PortCombo : public QComboBox
{
    Q_OBJECT

public:
    explicit PortCombo(PortList &ports, QWidget *parent = nullptr);

    QString port() const; ///< what LineFactory::open takes
    void setPort(const QString &name);
    void refresh();
    void setOpenPorts(const QStringList &names); ///< listed as long as they are open, wherever they come from

    void showPopup() override;

signals:
    void portChanged();

private:
    struct Entry {
        QString name;
        QString tip;
    };
    std::vector<Entry> entries() const;
    void place(const Entry &entry, int at);

    PortList &m_ports;
    QStringList m_open;
};

} // namespace dynascope
