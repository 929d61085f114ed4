// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"
#include "core/table/memo.h"
#include "core/table/tablebuilder.h"
#include "core/table/tableoutline.h"

#include <QByteArray>
#include <QJsonObject>

#include <deque>
#include <memory>

namespace dynascope {

constexpr int OldestTableFormat = 1;
constexpr int TableFormat = 2;

/// A table file and what it builds on. Immutable; parsed when its settings are first asked for.
class TableFile
{
public:
    /// `json` is a sound table file: one that check() found to be one, or that came with the program, which is known to
    /// be sound throughout. What is known is not looked for again.
    TableFile(QString name, QByteArray json, TableOutline outline, std::shared_ptr<const TableFile> base,
        bool isKnownSound);

    const QString &name() const { return m_name; }
    const TableOutline &outline() const { return m_outline; }
    /// What holds for all models of this file, what it extends included.
    TableOutline::Facts shared() const;
    /// The same, whole.
    const QJsonObject &settings() const { return parsed().settings; }
    /// What a model adds, as it stands in the file.
    QJsonObject changes(const QString &model) const { return parsed().models.value(model).toObject(); }
    /// What was wrong with building on another file; unset for every file that check() has passed.
    const TableFault &fault() const { return parsed().fault; }
    bool isKnownSound() const { return m_isKnownSound; }

    /// Keys and kinds of `json`, which `name` is for messages of.
    static Result<void> check(const QByteArray &json, const QString &name);
    /// "name: line 7: what".
    Error error(const QString &name, const TableFault &fault, const QString &model = {}) const;

private:
    struct Parsed {
        QJsonObject settings, models;
        TableFault fault;
    };
    const Parsed &parsed() const;

    QString m_name;
    QByteArray m_json;
    std::shared_ptr<const TableFile> m_base;
    TableOutline m_outline;
    bool m_isKnownSound;
    Memo<Parsed> m_parsed;
};

/// The tables of one model, each made when it is first asked for.
class ModelTables
{
public:
    ModelTables(QString model, std::shared_ptr<const TableFile> file)
        : m_model(std::move(model)), m_file(std::move(file))
    {
    }

    /// nullptr only where the file is wrong, see check().
    ControlTablePtr at(int firmware) const;
    std::vector<int> firmwareSteps() const; ///< from which firmware on each of them is
    /// Makes all of them and says what is wrong.
    TableFault check() const;

private:
    struct Step {
        explicit Step(int firstFirmware, int next) : from(firstFirmware), to(next) { }
        int from, to;
        Memo<ControlTablePtr> table;
    };
    TableBuilder builder(TableFault *fault) const;
    static const Step *stepAt(const std::deque<Step> &steps, int firmware);
    ControlTablePtr build(TableBuilder &from, const Step &step) const;
    const std::deque<Step> &steps(int firmware) const;

    QString m_model;
    std::shared_ptr<const TableFile> m_file;
    Memo<std::deque<Step>> m_steps;
};

} // namespace dynascope
