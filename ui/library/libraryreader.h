// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/catalog.h"
#include "core/table/registerindex.h"

#include <QObject>
#include <QTimer>

#include <chrono>

namespace dynascope {

/// Reads every table of a catalog into an index, a few milliseconds at a time, so that the window goes on meanwhile.
/// GUI thread.
class LibraryReader : public QObject
{
    Q_OBJECT

public:
    /// `turn`: how long at a time, at least one model. The catalog outlives it.
    explicit LibraryReader(const Catalog &catalog, QObject *parent = nullptr,
        std::chrono::milliseconds turn = std::chrono::milliseconds(6));

    void start(); ///< once; later calls do nothing
    bool isDone() const { return m_next == m_models.size(); }
    int done() const { return static_cast<int>(m_next); } ///< models
    int total() const { return static_cast<int>(m_models.size()); }
    const RegisterIndex &index() const { return m_index; }

signals:
    void progressed(); ///< the index knows more

private:
    void readSome();

    const Catalog &m_catalog;
    const std::chrono::milliseconds m_turn;
    std::vector<Catalog::ModelInfo> m_models;
    std::size_t m_next = 0;
    RegisterIndex m_index;
    QTimer m_timer;
};

} // namespace dynascope
