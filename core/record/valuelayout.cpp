// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/valuelayout.h"

#include "core/record/recordedvalue.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

namespace dynascope {
namespace {

constexpr std::array<std::uint8_t, 4> Encapsulation{0, 1, 0, 0}; ///< CDR, low byte first; numbers are aligned behind it

constexpr std::size_t TimeSize = 4;

bool isSingle(const RecordedField &field)
{
    return field.size <= 2;
}

std::size_t sizeOf(const RecordedField &field)
{
    return isSingle(field) ? sizeof(float) : sizeof(double);
}

template <typename Bits>
void putBits(Bits bits, std::uint8_t *to)
{
    for (std::size_t i = 0; i < sizeof(Bits); ++i)
        to[i] = static_cast<std::uint8_t>(bits >> (8 * i));
}

template <typename Bits>
Bits bitsAt(ByteView from, std::size_t offset)
{
    Bits bits = 0;
    for (std::size_t i = 0; i < sizeof(Bits); ++i)
        bits |= Bits(from[offset + i]) << (8 * i);
    return bits;
}

/// "Id1" of "id_1".
QString rosType(const QString &name)
{
    QString type;
    for (const QString &word : name.split(u'_', Qt::SkipEmptyParts))
        type += word[0].toUpper() + word.mid(1);
    return type;
}

} // namespace

QString rosName(QStringView name)
{
    QString result;
    for (const QChar c : name) {
        const char16_t one = c.toLower().unicode();
        const bool isPlain = (one >= u'a' && one <= u'z') || (one >= u'0' && one <= u'9');
        if (isPlain)
            result += one;
        else if (!result.isEmpty() && !result.endsWith(u'_'))
            result += u'_';
    }
    if (result.endsWith(u'_'))
        result.chop(1);
    if (result.isEmpty() || !(result[0] >= u'a' && result[0] <= u'z'))
        result.prepend(QStringLiteral("value_"));
    return result.endsWith(u'_') ? result.chopped(1) : result;
}

ValueLayout::ValueLayout(std::uint16_t address, std::uint16_t length, std::vector<Part> parts)
    : m_address(address)
    , m_length(length)
    , m_parts(std::move(parts))
    , m_size(Encapsulation.size())
{
    const auto place = [&](std::size_t size) {
        const std::size_t behind = m_size - Encapsulation.size();
        m_offsets.push_back(Encapsulation.size() + (behind + size - 1) / size * size);
        m_size = m_offsets.back() + size;
    };
    for (const Part &part : m_parts) {
        place(TimeSize);
        for (const RecordedField &field : part.fields)
            place(sizeOf(field));
    }
}

QString ValueLayout::definition() const
{
    QString text, types;
    for (const Part &part : m_parts) {
        const QString type = rosType(part.member);
        text += QStringLiteral("%1 %2\n").arg(type, part.member);
        types += QString(80, u'=') + QStringLiteral("\nMSG: dynascope/%1\nuint32 reply_us # after the message's time\n").arg(type);
        std::set<QString> used{QStringLiteral("reply_us")};
        for (const RecordedField &field : part.fields) {
            const QString plain = rosName(field.name);
            QString name = plain;
            for (int number = 2; !used.insert(name).second; ++number)
                name = QStringLiteral("%1_%2").arg(plain).arg(number);
            types += QStringLiteral("%1 %2").arg(isSingle(field) ? u"float32" : u"float64", name);
            types += field.unit.isEmpty() ? QStringLiteral("\n") : QStringLiteral(" # %1\n").arg(field.unit);
        }
    }
    return text + types;
}

void ValueLayout::encode(const std::vector<const RecordedReply *> &replies, LineTime begin, Bytes &message) const
{
    message.assign(m_size, 0);
    std::copy(Encapsulation.begin(), Encapsulation.end(), message.begin());
    std::size_t first = 0;
    for (std::size_t i = 0; i < m_parts.size(); ++i) {
        const auto after = std::chrono::duration_cast<std::chrono::microseconds>(replies[i]->at - begin).count();
        putBits(static_cast<std::uint32_t>(std::clamp<qint64>(after, 0, 0xFFFFFFFFLL)), message.data() + m_offsets[first]);
        put(m_parts[i], first + 1, *replies[i], message);
        first += 1 + m_parts[i].fields.size();
    }
}

void ValueLayout::put(const Part &part, std::size_t first, const RecordedReply &reply, Bytes &message) const
{
    const bool isWhole = reply.data.size() >= m_length; // half a reply is none
    for (std::size_t i = 0; i < part.fields.size(); ++i) {
        const RecordedField &field = part.fields[i];
        const auto raw = isWhole ? recordedRaw(field, m_address, reply.data) : std::nullopt;
        const double value = raw ? physicalValue(field, *raw) : std::numeric_limits<double>::quiet_NaN();
        if (isSingle(field))
            putBits(std::bit_cast<std::uint32_t>(static_cast<float>(value)), message.data() + m_offsets[first + i]);
        else
            putBits(std::bit_cast<std::uint64_t>(value), message.data() + m_offsets[first + i]);
    }
}

bool ValueLayout::decode(ByteView message, LineTime begin, std::vector<RecordedReply> &replies) const
{
    if (message.size() < m_size || !std::equal(Encapsulation.begin(), Encapsulation.end(), message.begin()))
        return false;
    std::size_t next = 0;
    for (const Part &part : m_parts) {
        RecordedReply &reply = replies.emplace_back();
        reply.device = part.device;
        reply.address = m_address;
        reply.length = m_length;
        reply.at = begin + std::chrono::microseconds(bitsAt<std::uint32_t>(message, m_offsets[next++]));
        reply.data.assign(m_length, 0);
        bool isWhole = true;
        for (const RecordedField &field : part.fields) {
            const std::size_t offset = m_offsets[next++];
            const double value = isSingle(field) ? double(std::bit_cast<float>(bitsAt<std::uint32_t>(message, offset)))
                                                 : std::bit_cast<double>(bitsAt<std::uint64_t>(message, offset));
            isWhole = isWhole && !std::isnan(value);
            if (isWhole)
                putRaw(field, m_address, rawValue(field, value), reply.data);
        }
        if (!isWhole)
            reply.data.clear();
    }
    return true;
}

} // namespace dynascope
