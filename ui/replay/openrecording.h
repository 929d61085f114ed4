// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStringList>

#include <functional>

class QMimeData;
class QWidget;

namespace dynascope {

/// Asks for a recording; `open` gets its path.
void askForRecording(QWidget *parent, std::function<void(const QString &path)> open);
/// The recordings among what is being dragged here.
QStringList recordingsOf(const QMimeData &dragged);

} // namespace dynascope
