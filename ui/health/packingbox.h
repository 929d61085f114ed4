// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/linesession.h"

#include <QFutureWatcher>
#include <QPointer>
#include <QWidget>

class QCheckBox;
class QLabel;

namespace dynascope {

class IndirectReads;

/// Scattered registers read by indirect addresses: the switch, and what it brings.
class PackingBox : public QWidget
{
    Q_OBJECT

public:
    PackingBox(IndirectReads &reads, LineSession &line, QWidget *parent);

private:
    void refresh();
    void predict(const PolledLine &without, const PolledLine &with);
    void showGain();


    IndirectReads &m_reads;
    QPointer<LineSession> m_line;
    QCheckBox *m_pack, *m_used;
    QLabel *m_gain;
    QString m_state;
    QFutureWatcher<std::pair<double, double>> m_predicting; ///< Hz without and with
};

} // namespace dynascope
