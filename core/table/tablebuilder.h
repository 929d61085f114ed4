// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/controltable.h"
#include "core/table/fieldreader.h"
#include "core/table/tablefault.h"

#include <QJsonObject>

namespace dynascope {

/// Under which a table file has its registers.
inline const QString RegistersKey = QStringLiteral("registers");

/// Makes the control tables of one model, one for each range of firmware with the same registers, from settings that
/// are merged already. Everything is checked here; the first thing wrong is kept.
class TableBuilder
{
public:
    /// `settings`: a file with all that it extends, and the model's own changes, "number" and "manual" among them.
    TableBuilder(QString model, QJsonObject settings);

    /// Where the table changes: 0, each first firmware of something new or gone, and one past the newest there can be.
    const std::vector<int> &steps() const { return m_steps; }
    /// The table from one step to the next; nullptr where something is wrong. Where registers are known to fit together
    /// that isn't looked for.
    ControlTablePtr build(int from, int to, bool isKnownSound);
    const ControlTable::Description &description() const { return m_common; }
    /// What is wrong: its text begins with the model's name, its path with the keys of a model's entry.
    const TableFault &fault() const { return m_fault; }

private:
    void readModel();
    void readAbilities();
    void readGear();
    void readBaudRates();
    int readFirmware(const QString &key);
    void readSteps();
    void collectSteps(const QJsonObject &json, QJsonObject::const_iterator reg, std::vector<int> &steps);
    void readRegisters(std::vector<Field> &fields);
    void readNumbered(const QString &name, const QJsonObject &json, std::vector<Field> &fields);
    void readIndirect(std::vector<Field> &fields);
    void readIndirectBlock(const QJsonObject &block, const QJsonValue &range, int &number, std::vector<Field> &fields);
    void add(const QString &name, const QString &key, const QJsonObject &json, std::vector<Field> &fields);
    void addCopies(const Field &first, const QString &name, int from, int count, int stride, int initialStep,
        std::vector<Field> &fields);
    void checkTogether(const std::vector<Field> &fields);
    void checkNames(const std::vector<Field> &fields);
    void checkResets(const Field &field);
    void checkBound(const Field &field, const Bound &bound, const QStringList &names, const QStringList &path);
    bool exists(const QJsonObject &json) const;
    std::int64_t numberIn(
        const QJsonObject &json, const QString &key, std::int64_t low, std::int64_t high, const QStringList &path);
    void say(const QStringList &path, const QString &what, const QStringList &elsewhere = {});
    void sayOf(const Field &field, const QString &what, const Field *other = nullptr);
    QStringList pathOf(const Field &field) const;

    QString m_model;
    QJsonObject m_settings;
    ControlTable::Description m_common; ///< but for the registers and the range of firmware
    FieldReader::Context m_context;
    std::vector<int> m_steps;
    TableFault m_fault;
};

} // namespace dynascope
