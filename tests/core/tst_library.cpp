// SPDX-License-Identifier: GPL-3.0-or-later
// Every table that comes with the program against the facts in tests/data/tables. What differs on purpose stands in
// differences.csv, with the reason.
#include "core/table/catalog.h"
#include "core/table/units.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/tablefacts.h"
#include "tests/support/testmain.h"

#include <QDir>
#include <QRegularExpression>
#include <QSet>

using namespace dynascope;
using namespace dynascope::test;

namespace {

constexpr int Newest = 255;

QString cell(const FactRow &row, const char *column)
{
    return row[QString::fromLatin1(column)];
}

int number(const FactRow &row, const char *column)
{
    const QString text = cell(row, column);
    return text.isEmpty() ? -1 : text.toInt();
}

QString plainNumber(const QString &text)
{
    return text.isEmpty() ? text : QString::number(text.toDouble(), 'g', 12);
}

std::vector<FactRow> complete()
{
    std::vector<FactRow> models = factRows(QStringLiteral("models"));
    std::erase_if(models, [](const FactRow &model) { return cell(model, "family").isEmpty(); });
    return models;
}

std::vector<int> numbersOf(const std::vector<EnumValue> &values)
{
    std::vector<int> numbers;
    for (const EnumValue &value : values)
        numbers.push_back(static_cast<int>(value.value));
    return numbers;
}

std::vector<int> numbersIn(const QString &text)
{
    std::vector<int> numbers;
    for (const QString &part : text.split(u' ', Qt::SkipEmptyParts))
        numbers.push_back(part.toInt());
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

QStringList bitsOf(const Field &field)
{
    QStringList bits;
    for (const BitField &bit : field.bits) {
        bits.append(bit.count == 1 ? QString::number(bit.first)
                                   : QStringLiteral("%1-%2").arg(bit.first).arg(bit.first + bit.count - 1));
    }
    if (field.directionBit >= 0)
        bits.append(QString::number(field.directionBit));
    return bits;
}

/// By name; of numbered ones the first.
const Field *named(const ControlTable &table, const QString &name)
{
    const Field *field = table.find(name);
    return field ? field : table.find(name + QStringLiteral(" 1"));
}

} // namespace

class TestLibrary : public QObject
{
    Q_OBJECT

    const Catalog m_catalog = builtInCatalog();
    const std::vector<FactRow> m_differences = factRows(QStringLiteral("differences"));
    QSet<QString> m_differencesSeen;

    std::vector<FactRow> modelsOf(const QString &families) const
    {
        const QStringList wanted = families.split(u' ');
        std::vector<FactRow> models = complete();
        std::erase_if(models, [&](const FactRow &model) { return !wanted.contains(cell(model, "family")); });
        return models;
    }

    void compare(const ControlTable &table, const FactRow &fact, const Field &field, const QStringList &columns)
    {
        FactRow here = factsOf(field);
        for (const QString &column : columns) {
            QString wanted = fact[column];
            if (column == u"scale")
                wanted = plainNumber(wanted);
            for (const FactRow &difference : m_differences) {
                if (cell(difference, "model") != table.model() || cell(difference, "register") != field.name
                    || cell(difference, "column") != column)
                    continue;
                QCOMPARE(wanted, cell(difference, "fact"));
                wanted = cell(difference, "here");
                m_differencesSeen.insert(table.model() + field.name + column);
            }
            QVERIFY2(here[column] == wanted,
                     qPrintable(QStringLiteral("%1: %2: %3 is \"%4\", the facts say \"%5\"")
                                    .arg(table.model(), field.name, column, here[column], wanted)));
        }
    }

    void compare(const ControlTable &table, const std::vector<FactRow> &facts, const QStringList &columns)
    {
        for (std::size_t i = 0; i < facts.size(); ++i) {
            QVERIFY2(i < table.fields().size(), qPrintable(cell(facts[i], "name")));
            compare(table, facts[i], table.fields()[i], columns);
            if (QTest::currentTestFailed())
                return;
        }
        QCOMPARE(table.fields().size(), facts.size());
    }

private slots:
    void everyModelIsThere()
    {
        const std::vector<FactRow> facts = factRows(QStringLiteral("models"));
        for (const FactRow &fact : facts) {
            const Catalog::ModelInfo *info = m_catalog.model(number(fact, "number"));
            QVERIFY2(info, qPrintable(cell(fact, "name")));
            QCOMPARE(info->model, cell(fact, "name"));
            QCOMPARE(info->series, cell(fact, "series"));
            QCOMPARE(info->addressesOnly, cell(fact, "family").isEmpty());
        }
        QCOMPARE(m_catalog.models().size(), facts.size());
        QCOMPARE(complete().size(), std::size_t(74));
    }

    void everyRegister_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<int>("firmware");
        QTest::addColumn<QString>("table");
        for (const FactRow &fact : complete()) {
            const int model = number(fact, "number");
            const QString table = cell(fact, "table"), older = table + QStringLiteral("-fw52");
            QTest::addRow("%s", qPrintable(table)) << model << Newest << table;
            if (QFile::exists(QStringLiteral(DYNASCOPE_SOURCE_DIR "/tests/data/tables/%1.csv").arg(older))) {
                for (const int firmware : {46, 51, 52})
                    QTest::addRow("%s at %d", qPrintable(table), firmware) << model << firmware << older;
                QTest::addRow("%s at 53", qPrintable(table)) << model << 53 << table;
            }
        }
    }

    void everyRegister()
    {
        QFETCH(int, model);
        QFETCH(int, firmware);
        QFETCH(QString, table);
        const ControlTablePtr here = m_catalog.find(model, firmware);
        QVERIFY(here);
        static const QStringList columns =
            QStringLiteral("address size name signed area access initial min max unit scale").split(u' ');
        compare(*here, registerRows(table), columns);
    }

    void everyAddress_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<QString>("table");
        for (const FactRow &fact : factRows(QStringLiteral("models"))) {
            if (cell(fact, "family").isEmpty())
                QTest::addRow("%s", qPrintable(cell(fact, "name"))) << number(fact, "number") << cell(fact, "table");
        }
    }

    /// Where only addresses are public the table knows no more than that, and says so.
    void everyAddress()
    {
        QFETCH(int, model);
        QFETCH(QString, table);
        const ControlTablePtr here = m_catalog.find(model, 0);
        QVERIFY(here);
        compare(*here, registerRows(table),
                {QStringLiteral("address"), QStringLiteral("size"), QStringLiteral("name")});
        QVERIFY(here->description().addressesOnly && !here->description().doubt.isEmpty());
        QVERIFY(here->description().baudCodes.empty() && !here->hasFastReads(Newest) && !here->hasBackup(Newest));
        for (const Field &field : here->fields()) {
            QVERIFY(field.area == Area::Unknown && field.access == Access::Unknown && !field.isWritable());
            QVERIFY(!field.initial && !field.minimum.isSet() && field.unit == Unit::None && field.values.empty());
        }
    }

    void everyDifferenceIsOne()
    {
        for (const FactRow &difference : m_differences) {
            const QString key = cell(difference, "model") + cell(difference, "register") + cell(difference, "column");
            QVERIFY2(m_differencesSeen.contains(key), qPrintable(key));
            QVERIFY(cell(difference, "reason").size() > 20);
        }
    }

    void everyModelsAbilities()
    {
        for (const FactRow &fact : complete()) {
            const ControlTablePtr table = m_catalog.find(number(fact, "number"), Newest);
            const ControlTable::Description &model = table->description();
            std::vector<int> codes;
            for (const BaudCode &baud : model.baudCodes)
                codes.push_back(baud.code);
            const QStringList range = cell(fact, "baudCodes").split(u'-');
            QCOMPARE(codes.front(), range[0].toInt());
            QCOMPARE(codes.back(), range[1].toInt());
            QCOMPARE(codes.size(), std::size_t(codes.back() - codes.front() + 1));
            QCOMPARE(model.operatingModes, numbersIn(cell(fact, "modes")));
            QCOMPARE(model.fastReadsFrom, number(fact, "fastReadsFrom"));
            QCOMPARE(model.backupFrom, number(fact, "backupFrom"));
            QVERIFY(model.manualPage.startsWith(u"https://emanual.robotis.com/docs/en/"));
            const Field *position = table->find(Known::PresentPosition);
            const EffectiveField now = effective(*position, {});
            if (const QString resolution = cell(fact, "resolution"); !resolution.isEmpty())
                QCOMPARE(qRound(table->resolution() * now.turns), resolution.toInt());
            double torque = 0;
            for (const Field &field : table->fields())
                torque = std::max(torque, field.torqueConstant);
            QCOMPARE(torque, cell(fact, "torqueConstant").toDouble());
        }
    }

    void everyValueAndBit()
    {
        for (const FactRow &fact : factRows(QStringLiteral("enums"))) {
            for (const FactRow &model : modelsOf(cell(fact, "families"))) {
                const ControlTablePtr table = m_catalog.find(number(model, "number"), Newest);
                const Field *field = named(*table, cell(fact, "register"));
                QVERIFY2(field, qPrintable(table->model() + u' ' + cell(fact, "register")));
                const QString where = table->model() + u' ' + field->name;
                if (cell(fact, "kind") == u"bits") {
                    QVERIFY2(bitsOf(*field) == cell(fact, "numbers").split(u' '), qPrintable(where));
                    continue;
                }
                const std::vector<EnumValue> &values = field->values.empty() ? field->special : field->values;
                // L42-10-S300-R has fewer modes than its series: everyModelsAbilities() has looked.
                if (field->name != u"Operating Mode" || cell(model, "modes") == cell(fact, "numbers"))
                    QVERIFY2(numbersOf(values) == numbersIn(cell(fact, "numbers")), qPrintable(where));
            }
        }
    }

    void everyAlternate()
    {
        for (const FactRow &fact : factRows(QStringLiteral("alternates"))) {
            for (const FactRow &model : modelsOf(cell(fact, "families"))) {
                const ControlTablePtr table = m_catalog.find(number(model, "number"), Newest);
                static const QRegularExpression form(QStringLiteral("^(.*) (?:bit(\\d+)=1|(\\d+))$"));
                const QRegularExpressionMatch match = form.match(cell(fact, "condition"));
                const std::int64_t value = match.captured(2).isEmpty() ? match.captured(3).toInt()
                                                                       : std::int64_t(1) << match.captured(2).toInt();
                const EffectiveField now = effective(*table->find(cell(fact, "register")), [&](QStringView name) {
                    return name == match.captured(1) ? std::optional(value) : std::nullopt;
                });
                const QString where = table->model() + u' ' + cell(fact, "register") + u' ' + cell(fact, "condition");
                QVERIFY2(now.minimum == cell(fact, "min").toLongLong(), qPrintable(where));
                QVERIFY2(now.maximum == cell(fact, "max").toLongLong(), qPrintable(where));
                QVERIFY2(tableUnit(now.unit) == cell(fact, "unit"), qPrintable(where));
                if (!cell(fact, "scale").isEmpty())
                    QVERIFY2(now.scale == cell(fact, "scale").toDouble(), qPrintable(where));
            }
        }
    }

    void everyFirmware()
    {
        for (const FactRow &fact : factRows(QStringLiteral("firmware"))) {
            const QString item = cell(fact, "item");
            const int first = cell(fact, "first") == u"never" ? -1 : number(fact, "first");
            for (const FactRow &model : modelsOf(cell(fact, "families"))) {
                const int modelNumber = number(model, "number");
                const ControlTable::Description description = m_catalog.find(modelNumber, Newest)->description();
                const QString where = description.model + u' ' + item;
                if (item.startsWith(u"instruction Fast "))
                    QVERIFY2(description.fastReadsFrom == first, qPrintable(where));
                else if (item == u"instruction Control Table Backup")
                    QVERIFY2(description.backupFrom == first, qPrintable(where));
                else if (item.startsWith(u"Factory Reset"))
                    QVERIFY2(description.resetByBroadcastUntil == first - 1, qPrintable(where));
                else
                    QVERIFY2(!has(modelNumber, first - 1, item) && has(modelNumber, first, item), qPrintable(where));
            }
        }
    }

    /// Read as strictly as anybody's file.
    void everyFileIsSound()
    {
        Catalog catalog;
        QStringList waiting = QDir(QStringLiteral(":/controltables")).entryList({QStringLiteral("*.json")});
        QVERIFY(waiting.size() > 30);
        for (bool progress = true; progress && !waiting.isEmpty();) {
            progress = false;
            for (const QString &name : QStringList(waiting)) {
                QFile file(QStringLiteral(":/controltables/") + name);
                QVERIFY(file.open(QIODevice::ReadOnly));
                const Result<void> added = catalog.add(file.readAll(), name);
                if (!added && added.error().text.contains(u"which is not there"))
                    continue; // what it extends comes later
                QVERIFY2(added, added ? "" : qPrintable(added.error().text));
                waiting.removeOne(name);
                progress = true;
            }
        }
        QCOMPARE(waiting, QStringList());
        QCOMPARE(catalog.models().size(), m_catalog.models().size());
    }

    /// What the catalog saw of a file at the start is what its tables say.
    void everyOutlineIsTrue()
    {
        for (const Catalog::ModelInfo &info : m_catalog.models()) {
            const ControlTable::Description model = m_catalog.find(info.modelNumber, Newest)->description();
            QCOMPARE(model.model, info.model);
            QCOMPARE(model.modelNumber, info.modelNumber);
            QCOMPARE(model.modbusNumber, info.modbusNumber);
            QCOMPARE(model.alsoCalled, info.alsoCalled);
            QCOMPARE(model.series, info.series);
            QCOMPARE(model.newestFirmware, info.newestFirmware);
            QCOMPARE(model.addressesOnly, info.addressesOnly);
            QVERIFY(info.isBuiltIn);
        }
    }

    void everyFieldIsExplained()
    {
        for (const Catalog::ModelInfo &info : m_catalog.models()) {
            for (const int firmware : m_catalog.firmwareSteps(info.modelNumber)) {
                const ControlTablePtr table = m_catalog.find(info.modelNumber, firmware);
                QCOMPARE(table->description().firmwareFrom, firmware);
                for (const Field &field : table->fields()) {
                    const QString where = info.model + u' ' + field.name;
                    QVERIFY2(field.help.size() > 20 && field.help.size() <= 600, qPrintable(where));
                    QVERIFY2(field.help.endsWith(u'.'), qPrintable(where));
                    QVERIFY2(field.doubt.isEmpty() || field.doubt.endsWith(u'.'), qPrintable(where));
                }
            }
        }
    }

private:
    /// A register, "Drive Mode bit3", or "Protocol Type 10 (...)".
    bool has(int model, int firmware, const QString &item) const
    {
        const ControlTablePtr table = m_catalog.find(model, firmware);
        static const QRegularExpression form(QStringLiteral("^(.*?)(?: bit(\\d+)| (\\d+) \\(.*)?$"));
        const QRegularExpressionMatch match = form.match(item);
        const Field *field = table->find(match.captured(1));
        if (!field)
            return false;
        if (!match.captured(2).isEmpty())
            return bitsOf(*field).contains(match.captured(2));
        const std::vector<int> values = numbersOf(field->values);
        return match.captured(3).isEmpty()
               || std::find(values.begin(), values.end(), match.captured(3).toInt()) != values.end();
    }
};

DYNASCOPE_CORE_TEST(TestLibrary)
#include "tst_library.moc"
