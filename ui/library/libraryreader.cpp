// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/libraryreader.h"

#include <QElapsedTimer>

namespace dynascope {

LibraryReader::LibraryReader(const Catalog &catalog, QObject *parent, std::chrono::milliseconds turn)
    : QObject(parent), m_catalog(catalog), m_turn(turn), m_models(catalog.models())
{
    connect(&m_timer, &QTimer::timeout, this, &LibraryReader::readSome);
}

void LibraryReader::start()
{
    if (!isDone() && !m_timer.isActive())
        m_timer.start(0);
}

void LibraryReader::readSome()
{
    QElapsedTimer turn;
    turn.start();
    while (!isDone()) {
        const int number = m_models[m_next].modelNumber;
        for (const int firmware : m_catalog.firmwareSteps(number)) {
            if (const ControlTablePtr table = m_catalog.find(number, firmware))
                m_index.add(*table);
        }
        ++m_next;
        if (turn.elapsed() >= m_turn.count())
            break;
    }
    if (isDone())
        m_timer.stop();
    emit progressed();
}

} // namespace dynascope
