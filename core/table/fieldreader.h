// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/field.h"

#include <QJsonObject>
#include <QJsonValue>

/// Parts of the table loader that read single values (FORMAT.md, "Registers").
namespace dynascope {

constexpr int NewestFirmware = 255; ///< the register has one byte

/// A whole number that a double holds exactly.
std::optional<std::int64_t> wholeNumber(const QJsonValue &value);

/// Does "since" and "until" of `json`, each optional, let this firmware in?
bool holdsFor(const QJsonObject &json, int firmware);

/// Reads one register of merged settings for one firmware. The first thing wrong is kept, and reading goes on
/// harmlessly.
class FieldReader
{
public:
    struct Context {
        std::uint16_t modelNumber = 0;
        int firmware = 0;
        QJsonObject registers; ///< all of the model, for what depends on other registers
        QJsonObject baudRates;
        QJsonObject scales;     ///< by name
        QJsonObject valueLists; ///< by name
        GearRatio gearRatio;
        double torqueConstant = 0;
        bool addressesOnly = false;
        bool isKnownSound = false; ///< names aren't looked at again
    };

    explicit FieldReader(const Context &context) : m_context(context) { }

    /// Once.
    Field read(const QString &name, const QJsonObject &json);
    /// What is wrong, beginning with the register's name; empty where nothing is.
    const QString &wrong() const { return m_wrong; }
    /// The keys within the register that lead to it.
    const QStringList &wrongPath() const { return m_wrongPath; }

private:
    void readPlace(const QJsonObject &json);
    void readMeaning(const QJsonObject &json);
    void readInitial(const QJsonValue &value);
    void readRange(const QJsonValue &value, Bound &minimum, Bound &maximum);
    void readUnit(const QJsonObject &json, Unit &unit, double &scale);
    void readScale(const QJsonValue &value, double &scale);
    void readDirectionBit(const QJsonValue &value, int &bit);
    QJsonValue listed(const QJsonValue &value);
    std::vector<EnumValue> readNamed(const QJsonValue &value, bool distinct);
    void readBits(const QJsonObject &json);
    void readBit(const QString &name, const QJsonObject &json);
    void readAlternates(const QJsonValue &value);
    std::optional<Alternate> readAlternate(const QJsonObject &json);
    bool resolveBit(const QJsonObject &decider, const QString &bit, Alternate &alternate);
    bool resolveValues(const QJsonObject &decider, const QJsonArray &values, Alternate &alternate);
    void readTexts(const QJsonObject &json);
    QString readText(const QJsonObject &json, const QString &key);
    Bound readBound(const QJsonValue &value);
    void checkFits(std::int64_t number, const QString &what);
    void checkLabel(const QString &text);
    void say(const QString &what);

    const Context &m_context;
    Field m_field;
    QString m_reading;    ///< the key being read
    int m_alternate = -1; ///< of this alternate; −1: of the register itself
    QString m_wrong;
    QStringList m_wrongPath;
};

} // namespace dynascope
