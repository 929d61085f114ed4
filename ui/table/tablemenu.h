// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QModelIndex>

#include <functional>

class QPoint;
class QWidget;

namespace dynascope {

/// What the menu of a row offers to do; empty functions for what isn't possible.
struct TableMenuActions {
    std::function<void()> togglePlot;
    std::function<void()> edit;
    std::function<void()> copyValue;
    std::function<void()> resetToDefault;
    std::function<void()> setAgain; ///< what a restart took; only where it did
    std::function<void()> readAgain;
    std::function<void()> editAll;  ///< of several devices: asks what to set on all of them
    std::function<void()> copyToAll; ///< sets this cell's value on all of them
    QString value;                   ///< which that is
    int deviceCount = 1;
};

/// Pops it up and returns; it deletes itself.
void popupTableMenu(const QModelIndex &cell, const TableMenuActions &actions, const QPoint &at, QWidget *parent);

} // namespace dynascope
