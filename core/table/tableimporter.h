// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/cellrows.h"
#include "core/table/tableimport.h"
#include "core/table/tablewriter.h"

#include <QHash>
#include <QMap>
#include <QSet>

namespace dynascope {

/// What the readers of foreign formats share: collects what is found and refuses what can't be, with the line.
class TableImporter
{
public:
    TableImporter(QString fileName, ImportOptions options)
        : m_fileName(std::move(fileName)), m_options(std::move(options))
    {
    }

    Result<ImportedTable> fromModel(const QByteArray &text);
    Result<ImportedTable> fromCsv(const QByteArray &text);

private:
    static constexpr qsizetype MostColumns = 64; ///< further ones are nobody's: a name is looked up in each row

    std::vector<CellRow> rows(const QByteArray &text, QChar separator);
    void typeInfo(const CellRow &row, double &zero, double &lowest, double &lowestRadian);
    void unitInfo(const CellRow &row, const QStringList &header);
    void takeUnit(Field &field, double value, const QString &unit, int line);
    void controlRow(const CellRow &row);
    void csvRow(const CellRow &row, const QStringList &header);
    void csvUnit(const CellRow &row, const QStringList &header, Field &field);
    Bound bound(const QString &text, int line);
    std::int64_t number(const QString &text, std::int64_t low, std::int64_t high, const QString &what, int line);
    void add(const Field &field, int line, bool aliasesAllowed);
    void applyUnits();
    Result<ImportedTable> finished();
    void note(const QString &text) { m_notes.append(QStringLiteral("%1: %2").arg(m_fileName, text)); }
    QString inItsOwnLine(const QString &error, const QByteArray &json) const;
    void say(int line, const QString &what);
    QString modelName() const;

    struct UnitRow {
        int line = 0;
        double value = 1;
        QString unit;
        bool isSigned = false;
    };

    QString m_fileName;
    ImportOptions m_options;
    WrittenModel m_model;
    QMap<QString, UnitRow> m_units; ///< by register
    QSet<QString> m_names;          ///< normalized
    QHash<QString, int> m_lines;    ///< in which each register stands
    QHash<int, QString> m_owners;   ///< registers by the addresses of their bytes
    QHash<QString, int> m_aliases;  ///< left out, and where they stand
    QStringList m_notes;
    QString m_wrong;
};

} // namespace dynascope
