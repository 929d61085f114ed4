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

bool isSingle(const RecordedField &field)
{
    return field.size <= 2;
}

std::size_t sizeOf(const RecordedField &field)
{
    return isSingle(field) ? sizeof(float) : sizeof(double);
}

template <typename Bits, typename Number>
void put(Number number, std::uint8_t *to)
{
    const Bits bits = std::bit_cast<Bits>(number);
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

ValueLayout::ValueLayout(std::uint16_t address, std::uint16_t length, std::vector<RecordedField> fields)
    : m_address(address)
    , m_length(length)
    , m_fields(std::move(fields))
    , m_size(Encapsulation.size())
{
    for (const RecordedField &field : m_fields) {
        const std::size_t size = sizeOf(field);
        const std::size_t behind = m_size - Encapsulation.size();
        m_offsets.push_back(Encapsulation.size() + (behind + size - 1) / size * size);
        m_size = m_offsets.back() + size;
    }
}

QString ValueLayout::definition() const
{
    QString text;
    std::set<QString> used;
    for (const RecordedField &field : m_fields) {
        const QString plain = rosName(field.name);
        QString name = plain;
        for (int number = 2; !used.insert(name).second; ++number)
            name = QStringLiteral("%1_%2").arg(plain).arg(number);
        text += QStringLiteral("%1 %2").arg(isSingle(field) ? u"float32" : u"float64", name);
        text += field.unit.isEmpty() ? QStringLiteral("\n") : QStringLiteral(" # %1\n").arg(field.unit);
    }
    return text;
}

void ValueLayout::encode(ByteView registers, Bytes &message) const
{
    message.assign(m_size, 0);
    std::copy(Encapsulation.begin(), Encapsulation.end(), message.begin());
    const bool isWhole = registers.size() >= m_length; // half a reply is none
    for (std::size_t i = 0; i < m_fields.size(); ++i) {
        const std::optional<std::int64_t> raw =
            isWhole ? recordedRaw(m_fields[i], m_address, registers) : std::nullopt;
        const double value = raw ? physicalValue(m_fields[i], *raw) : std::numeric_limits<double>::quiet_NaN();
        if (isSingle(m_fields[i]))
            put<std::uint32_t>(static_cast<float>(value), message.data() + m_offsets[i]);
        else
            put<std::uint64_t>(value, message.data() + m_offsets[i]);
    }
}

bool ValueLayout::decode(ByteView message, Bytes &registers) const
{
    registers.clear();
    if (message.size() < m_size || !std::equal(Encapsulation.begin(), Encapsulation.end(), message.begin()))
        return false;
    registers.assign(m_length, 0);
    for (std::size_t i = 0; i < m_fields.size(); ++i) {
        const double value = isSingle(m_fields[i])
            ? double(std::bit_cast<float>(bitsAt<std::uint32_t>(message, m_offsets[i])))
            : std::bit_cast<double>(bitsAt<std::uint64_t>(message, m_offsets[i]));
        if (std::isnan(value)) {
            registers.clear();
            return true;
        }
        putRaw(m_fields[i], m_address, rawValue(m_fields[i], value), registers);
    }
    return true;
}

} // namespace dynascope
