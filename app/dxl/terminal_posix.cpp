// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/terminal.h"

#include <QByteArray>

#include <algorithm>

#include <unistd.h>

namespace dynascope::dxl {

bool isTerminal(std::FILE *stream)
{
    return ::isatty(::fileno(stream)) == 1;
}

bool answersYes(const QString &question)
{
    std::fprintf(stderr, "dxl: %s ", qUtf8Printable(question));
    std::fflush(stderr);
    char answer[16];
    const ssize_t length = ::read(STDIN_FILENO, answer, sizeof answer); // not fgets: a signal ends it
    return QByteArray(answer, static_cast<qsizetype>(std::max<ssize_t>(0, length))).trimmed().toLower() == "yes";
}

} // namespace dynascope::dxl
