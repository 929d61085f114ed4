# SPDX-License-Identifier: GPL-3.0-or-later
# What most files include, read once for each library: half of the time that they take to compile. Nothing of ours is among
# it, or each change there would compile everything. The presets clang and lint do without, so that they show what a
# file forgot to include.
set(DYNASCOPE_COMMON_HEADERS <QFile> <QJsonArray> <QJsonDocument> <QJsonObject> <QObject> <QString> <QStringList> <algorithm>
    <array> <chrono> <cmath> <deque> <functional> <map> <memory> <optional> <set> <span> <variant> <vector>
    <tl/expected.hpp>)
