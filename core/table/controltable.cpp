// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/controltable.h"

#include <algorithm>

namespace dynascope {

namespace {

constexpr std::array<QStringView, static_cast<std::size_t>(Known::PresentPosition) + 1> KnownNames{
    u"ID",
    u"Secondary ID",
    u"Baud Rate",
    u"Return Delay Time",
    u"Status Return Level",
    u"Operating Mode",
    u"Torque Enable",
    u"LED",
    u"Hardware Error Status",
    u"Present Position",
};

/// What a character counts for where names are compared; a space: nothing.
QChar plain(QChar c)
{
    const bool isPlain = c > u' ' && c < u'\x7f'; // all of the manufacturer's, and quicker
    if (c == u'-' || c == u'_' || (!isPlain && c.isSpace()))
        return u' ';
    return !isPlain ? c.toLower() : c >= u'A' && c <= u'Z' ? QChar(c.unicode() + 32) : c;
}

/// Of names that are compared as one the same (FNV-1a).
std::uint32_t hashOf(QStringView name)
{
    std::uint32_t hash = 2166136261U;
    for (const QChar c : name) {
        if (const QChar counts = plain(c); counts != u' ')
            hash = (hash ^ counts.unicode()) * 16777619U;
    }
    return hash;
}

} // namespace

QStringView nameOf(Known field)
{
    return KnownNames[static_cast<std::size_t>(field)];
}

ControlTable::ControlTable(Description description) : m_description(std::move(description))
{
    m_byName.reserve(m_description.fields.size());
    for (std::size_t i = 0; i < m_description.fields.size(); ++i) {
        const Field &field = m_description.fields[i];
        m_byName.emplace_back(hashOf(field.name), static_cast<int>(i));
        m_size = std::max(m_size, field.end());
    }
    std::sort(m_byName.begin(), m_byName.end());
    // The program means nothing in a table of bytes without names.
    for (std::size_t i = 0; i < m_known.size(); ++i)
        m_known[i] = m_description.isRaw ? -1 : indexOf(KnownNames[i]);
}

int ControlTable::indexOf(QStringView name) const
{
    const std::pair<std::uint32_t, int> wanted(hashOf(name), -1);
    for (auto it = std::lower_bound(m_byName.begin(), m_byName.end(), wanted);
         it != m_byName.end() && it->first == wanted.first; ++it) {
        const QString &found = m_description.fields[static_cast<std::size_t>(it->second)].name;
        if (found == name || normalizedName(found) == normalizedName(name))
            return it->second;
    }
    return -1;
}

const Field *ControlTable::find(QStringView name) const
{
    const int index = indexOf(name);
    return index < 0 ? nullptr : &m_description.fields[static_cast<std::size_t>(index)];
}

const Field *ControlTable::find(Known field) const
{
    const int index = indexOf(field);
    return index < 0 ? nullptr : &m_description.fields[static_cast<std::size_t>(index)];
}

const Field *ControlTable::at(int address) const
{
    const auto &all = m_description.fields;
    const auto found = std::lower_bound(
        all.begin(), all.end(), address, [](const Field &field, int wanted) { return field.address < wanted; });
    return found != all.end() && found->address == address ? &*found : nullptr;
}

int ControlTable::indexOf(const Field *field) const
{
    // Only a field of this very table has an index; by address, so that a foreign pointer is never subtracted from.
    if (!field || at(field->address) != field)
        return -1;
    return static_cast<int>(field - m_description.fields.data());
}

std::optional<int> ControlTable::baudRate(int code) const
{
    for (const BaudCode &baud : m_description.baudCodes) {
        if (baud.code == code)
            return baud.rate;
    }
    return std::nullopt;
}

std::optional<int> ControlTable::baudCode(int rate) const
{
    for (const BaudCode &baud : m_description.baudCodes) {
        if (baud.rate == rate)
            return baud.code;
    }
    return std::nullopt;
}

bool ControlTable::hasFastReads(int firmware) const
{
    return m_description.fastReadsFrom >= 0 && firmware >= m_description.fastReadsFrom;
}

bool ControlTable::hasBackup(int firmware) const
{
    return m_description.backupFrom >= 0 && firmware >= m_description.backupFrom;
}

bool ControlTable::hasClear(int firmware) const
{
    return m_description.clearFrom >= 0 && firmware >= m_description.clearFrom;
}

bool ControlTable::isNewerThanKnown(int firmware) const
{
    return m_description.newestFirmware >= 0 && firmware > m_description.newestFirmware;
}

QString normalizedName(QStringView name)
{
    QString text(name.size(), Qt::Uninitialized);
    QChar *out = text.data();
    qsizetype length = 0;
    for (const QChar c : name) {
        if (const QChar counts = plain(c); counts != u' ')
            out[length++] = counts;
    }
    text.truncate(length);
    return text;
}

} // namespace dynascope
