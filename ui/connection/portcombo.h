// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QComboBox>

namespace dynascope {

class PortList;

/// The ports there are, looked up anew whenever the list opens; any other path can be typed.
class PortCombo : public QComboBox
{
    Q_OBJECT

public:
    explicit PortCombo(PortList &ports, QWidget *parent = nullptr);

    QString port() const; ///< what LineFactory::open takes
    void setPort(const QString &name);
    void refresh();

    void showPopup() override;

signals:
    void portChanged();

private:
    PortList &m_ports;
};

} // namespace dynascope
