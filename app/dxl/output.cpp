// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/output.h"

#include "app/dxl/terminal.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace dynascope::dxl {

void Output::print(const QByteArray &text)
{
    wipe();
    if (m_closed)
        return;
    // A scan is followed as it goes, also through a pipe.
    const bool printed = std::fwrite(text.constData(), 1, static_cast<std::size_t>(text.size()), stdout)
                             == static_cast<std::size_t>(text.size())
                         && std::fflush(stdout) == 0;
    if (printed)
        return;
    const int why = errno;
    m_closed = true;
    m_failed = why != EPIPE;
    if (m_failed)
        note(QStringLiteral("standard output can't be written: %1").arg(QString::fromLocal8Bit(std::strerror(why))));
}

void Output::result(const QString &text, const Document &document)
{
    if (m_json)
        m_documents.append(document.toJson());
    else
        print(text.toUtf8() + '\n');
}

void Output::result(std::uint8_t id, const QString &text, const Document &document)
{
    result(named(id, text), document);
}

QString Output::named(std::uint8_t id, const QString &text) const
{
    return m_nameDevices ? QStringLiteral("ID %1: %2").arg(QString::number(id), text) : text;
}

void Output::line(const QByteArray &text)
{
    print(text + '\n');
}

void Output::failedResult(const Document &document)
{
    if (m_json && m_many)
        m_documents.append(document.toJson());
}

void Output::unconfirmed(const QString &text, const Document &document)
{
    note(text);
    if (m_json)
        m_documents.append(document.toJson());
}

ExitCode Output::fail(const Error &error)
{
    if (error.kind != ErrorKind::Cancelled) // said once, at the end
        note(error.text);
    return ExitCode::Failed;
}

ExitCode Output::refuse(const Error &error)
{
    note(error.text);
    return ExitCode::Usage;
}

void Output::note(const QString &text)
{
    wipe();
    std::fprintf(stderr, "dxl: %s\n", qUtf8Printable(text));
}

void Output::progress(double done, const QString &text)
{
    if (!isTerminal(stderr))
        return;
    constexpr int Width = 24;
    const int full = static_cast<int>(std::clamp(done, 0.0, 1.0) * Width);
    const QByteArray bar = QByteArray(full, '#') + QByteArray(Width - full, '.');
    std::fprintf(stderr, "\r\033[K[%s] %3d %%  %s", bar.constData(), static_cast<int>(done * 100),
                 qUtf8Printable(text));
    std::fflush(stderr);
    m_barShown = true;
}

void Output::wipe()
{
    if (m_barShown)
        std::fputs("\r\033[K", stderr);
    m_barShown = false;
}

void Output::finish()
{
    wipe();
    if (!m_json || m_lines)
        return;
    if (m_many)
        print('[' + m_documents.join(",\n ") + "]\n");
    else if (!m_documents.isEmpty())
        print(m_documents.constFirst() + '\n');
}

QString aligned(const std::vector<QStringList> &rows, const std::vector<std::size_t> &leftColumns)
{
    std::vector<qsizetype> widths(static_cast<std::size_t>(rows.front().size()), 0);
    for (const QStringList &row : rows) {
        for (std::size_t i = 0; i < widths.size(); ++i)
            widths[i] = std::max(widths[i], row[static_cast<qsizetype>(i)].size());
    }
    QStringList lines;
    for (const QStringList &row : rows) {
        QStringList cells;
        for (std::size_t i = 0; i < widths.size(); ++i) {
            const QString &cell = row[static_cast<qsizetype>(i)];
            const bool left = std::ranges::find(leftColumns, i) != leftColumns.end();
            cells << (left ? cell.leftJustified(widths[i]) : cell.rightJustified(widths[i]));
        }
        QString line = cells.join(QStringLiteral("  "));
        while (line.endsWith(u' '))
            line.chop(1);
        lines << line;
    }
    return lines.join(u'\n');
}

} // namespace dynascope::dxl
