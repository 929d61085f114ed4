// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journalfile.h"

#include <QDir>
#include <QFile>

#include <algorithm>

namespace dynascope {
namespace {

constexpr int LongestWait = 10'000; ///< ms; whoever holds the lock longer has died

tl::unexpected<Error> unwritable(const QString &path, const QString &why)
{
    return failure(ErrorKind::BadFile, QStringLiteral("the journal %1 can't be written: %2").arg(path, why));
}

} // namespace

JournalFile::JournalFile(QString folder, const Bounds &bounds) : m_folder(std::move(folder)), m_bounds(bounds) { }

QString JournalFile::path(int number) const
{
    return QStringLiteral("%1/journal-%2.jsonl").arg(m_folder).arg(number, 6, 10, QLatin1Char('0'));
}

std::vector<int> JournalFile::numbers() const
{
    std::vector<int> found;
    for (const QString &name : QDir(m_folder).entryList({QStringLiteral("journal-??????.jsonl")}, QDir::Files)) {
        bool isNumber = false;
        const int number = name.mid(8, 6).toInt(&isNumber);
        if (isNumber && number > 0)
            found.push_back(number);
    }
    std::ranges::sort(found);
    return found;
}

Result<std::unique_ptr<QLockFile>> JournalFile::lock(std::chrono::milliseconds patience)
{
    if (!QDir().mkpath(m_folder))
        return unwritable(m_folder, QStringLiteral("the folder can't be made"));
    auto held = std::make_unique<QLockFile>(m_folder + QStringLiteral("/journal.lock"));
    held->setStaleLockTime(LongestWait);
    if (held->tryLock(static_cast<int>(patience.count())))
        return held;
    if (held->error() != QLockFile::LockFailedError)
        return unwritable(m_folder, QStringLiteral("no permission, or no room"));
    return failure(ErrorKind::PortBusy,
                   unwritable(m_folder, QStringLiteral("another program holds journal.lock")).value().text);
}

void JournalFile::read(const std::function<void(const QByteArray &)> &take)
{
    std::vector<int> there = numbers();
    if (there.empty() || there.back() < m_number) { // somebody removed what was read
        m_number = 0;
        m_offset = 0;
    }
    if (m_number == 0 && there.size() > static_cast<std::size_t>(m_bounds.files))
        there.erase(there.begin(), there.end() - m_bounds.files); // whoever put them there
    for (const int number : there) {
        if (number < m_number)
            continue;
        if (number > m_number) {
            m_number = number;
            m_offset = 0;
        }
        if (!readFile(number, take))
            return;
    }
}

void JournalFile::beginNearEnd(qint64 bytes)
{
    const std::vector<int> there = numbers();
    for (std::size_t i = there.size(); i-- > 0 && bytes > 0;) {
        const qint64 size = QFile(path(there[i])).size();
        m_number = there[i];
        m_offset = std::max<qint64>(0, size - bytes); // in a line, most likely, whose rest is no entry
        bytes -= size;
    }
}

bool JournalFile::readFile(int number, const std::function<void(const QByteArray &)> &take)
{
    QFile file(path(number));
    if (!file.open(QIODevice::ReadOnly))
        return false;
    // Not ours where it is much longer than we let one become: the newest part is enough.
    const qint64 longest = m_bounds.fileSize + 2 * m_bounds.lineLength;
    bool skipping = false;
    if (file.size() < m_offset) // it was cut off, or is another one
        m_offset = 0;
    if (file.size() - m_offset > longest) {
        m_offset = file.size() - longest;
        skipping = true; // begins somewhere in a line
    }
    file.seek(m_offset);
    while (true) {
        const QByteArray line = file.readLine(m_bounds.lineLength + 1);
        const bool isWhole = line.endsWith('\n');
        if (!isWhole && line.size() < m_bounds.lineLength)
            return true; // the end; what stands there without its line break may still be written
        m_offset += line.size();
        if (isWhole && !skipping && line.size() > 1)
            take(line.chopped(1));
        skipping = !isWhole;
    }
}

Result<void> JournalFile::append(const QByteArray &line)
{
    const std::vector<int> there = numbers();
    int number = there.empty() ? 1 : there.back();
    if (QFile(path(number)).size() >= m_bounds.fileSize)
        ++number;
    QFile file(path(number));
    if (!file.open(QIODevice::ReadWrite | QIODevice::Append))
        return unwritable(file.fileName(), file.errorString());
    QByteArray text = line + '\n';
    if (const qint64 size = file.size(); size > 0) {
        file.seek(size - 1);
        if (file.read(1) != "\n")
            text.prepend('\n'); // a program ended in the middle of a line
        file.seek(size);
    }
    if (file.write(text) != text.size() || !file.flush())
        return unwritable(file.fileName(), file.errorString());
    if (number == m_number && m_offset + text.size() == file.size())
        m_offset = file.size(); // ours needn't be read again
    for (const int old : there) {
        if (old <= number - m_bounds.files)
            QFile::remove(path(old));
    }
    return {};
}

} // namespace dynascope
