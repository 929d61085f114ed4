// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/controltable.h"
#include "core/table/fieldreader.h"

#include <QJsonObject>

namespace dynascope {

/// Makes the control tables of one model, one for each range of firmware with the same registers, from settings that
/// are merged already. Everything is checked here; the first thing wrong is kept.
class TableBuilder
{
public:
    /// `settings`: a file with all that it extends, and the model's own changes, "number" and "manual" among them.
    TableBuilder(QString model, QJsonObject settings);

    std::vector<ControlTablePtr> build();
    int newestFirmware() const { return m_newestFirmware; }
    const ControlTable::Description &description() const { return m_common; }
    /// What is wrong, beginning with the model's name; empty where nothing is.
    const QString &wrong() const { return m_wrong; }

private:
    void readModel();
    void readBaudRates();
    int readFirmware(const QString &key);
    std::vector<int> firmwareSteps();
    void collectSteps(const QJsonValue &value, const QString &where, std::vector<int> &steps);
    ControlTablePtr buildFor(int from, int to);
    void readRegisters(std::vector<Field> &fields);
    void readNumbered(const QString &name, const QJsonObject &json, std::vector<Field> &fields);
    void readIndirect(std::vector<Field> &fields);
    void readIndirectBlock(const QJsonObject &block, const QJsonValue &range, int &number, std::vector<Field> &fields);
    void add(const QString &name, const QJsonObject &json, std::vector<Field> &fields);
    void checkTogether(std::vector<Field> &fields);
    void checkNames(std::vector<Field> &fields);
    void checkBound(const Field &field, const Bound &bound, const QStringList &names);
    std::int64_t numberIn(
        const QJsonObject &json, const QString &key, std::int64_t low, std::int64_t high, const QString &where);
    void say(const QString &what);

    QString m_model;
    QJsonObject m_settings;
    ControlTable::Description m_common; ///< but for the registers and the range of firmware
    FieldReader::Context m_context;
    int m_newestFirmware = 0;
    QString m_wrong;
};

} // namespace dynascope
