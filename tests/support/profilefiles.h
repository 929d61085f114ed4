// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/profileworld.h"

#include <QDir>
#include <QFile>

namespace dynascope::test {

inline QString writeFile(const QString &folder, const QString &name, const QByteArray &text)
{
    QFile file(QDir(folder).filePath(name));
    if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size())
        qFatal("%s could not be written", qPrintable(file.fileName()));
    return file.fileName();
}

inline QByteArray readFile(const QString &path)
{
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

inline bool isRegisterWrite(ByteView packet)
{
    const auto instruction = static_cast<Instruction>(packet[7]);
    return instruction == Instruction::Write || instruction == Instruction::SyncWrite
           || instruction == Instruction::BulkWrite || instruction == Instruction::RegWrite;
}

} // namespace dynascope::test
