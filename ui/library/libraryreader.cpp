// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/libraryreader.h"

#include <QElapsedTimer>

namespace dynascope {
namespace {

constexpr qint64 TurnMs = 6; ///< of the GUI thread's time, then the window's own events have their turn

} // namespace

LibraryReader::LibraryReader(const Catalog &catalog, QObject *parent)
    : QObject(parent), m_catalog(catalog), m_models(catalog.models())
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
    while (!isDone() && turn.elapsed() < TurnMs) {
        const int number = m_models[m_next].modelNumber;
        for (const int firmware : m_catalog.firmwareSteps(number)) {
            if (const ControlTablePtr table = m_catalog.find(number, firmware))
                m_index.add(*table);
        }
        ++m_next;
    }
    if (isDone())
        m_timer.stop();
    emit progressed();
}

} // namespace dynascope
