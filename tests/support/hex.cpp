// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/hex.h"

#include <QByteArray>

namespace hex {

dynascope::Bytes bytes(const char *text)
{
    const QByteArray raw = QByteArray::fromHex(QByteArray(text));
    return {raw.begin(), raw.end()};
}

QString text(dynascope::ByteView bytes)
{
    const QByteArray raw(reinterpret_cast<const char *>(bytes.data()), static_cast<qsizetype>(bytes.size()));
    return QString::fromLatin1(raw.toHex(' ').toUpper());
}

} // namespace hex
