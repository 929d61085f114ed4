// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/builtincatalog.h"
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/devices/devicepanel.h"
#include "ui/library/librarydialog.h"
#include "ui/library/libraryreader.h"
#include "ui/library/modeldelegate.h"
#include "ui/library/registermodel.h"
#include "ui/library/searchmodel.h"
#include "ui/mainwindow.h"

#include <QAction>
#include <QClipboard>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QSettings>
#include <QTextBrowser>
#include <QToolButton>
#include <QTreeView>

using namespace Qt::StringLiterals;
using namespace dynascope;

namespace {

QString textOf(const QModelIndex &index)
{
    return index.data().toString();
}

} // namespace

/// Looking control tables up without a device.
class TestLibrary : public QObject
{
    Q_OBJECT

    Catalog m_catalog = test::builtInCatalog();
    std::vector<RefusedTable> m_refused;
    std::unique_ptr<LibraryDialog> m_dialog;

    template <typename T>
    T *find(const char *name) const
    {
        T *child = m_dialog->findChild<T *>(QString::fromLatin1(name));
        if (!child)
            qFatal("no %s", name);
        return child;
    }

    void open()
    {
        m_dialog = std::make_unique<LibraryDialog>(m_catalog, m_refused);
        m_dialog->show();
        QVERIFY(QTest::qWaitForWindowExposed(m_dialog.get()));
    }

    /// The rows of a list, each as the texts of these columns; what is below a row only where it is expanded.
    static QStringList rows(const QTreeView &view, const QList<int> &columns)
    {
        QStringList lines;
        for (QModelIndex row = view.model()->index(0, 0); row.isValid(); row = view.indexBelow(row)) {
            QStringList cells;
            for (const int column : columns)
                cells << textOf(row.siblingAtColumn(column));
            lines << cells.join(u'|');
        }
        return lines;
    }

    QString page() const { return find<QTextBrowser>("libraryPage")->toPlainText(); }
    QString facts() const { return find<QLabel>("libraryFacts")->text(); }
    QString modelShown() const { return find<QLabel>("libraryModel")->text(); }
    QTreeView *registers() const { return find<QTreeView>("libraryRegisters"); }
    QTreeView *results() const { return find<QTreeView>("libraryResults"); }
    QLineEdit *search() const { return find<QLineEdit>("librarySearch"); }

    void selectRegister(const QString &name) const
    {
        const QAbstractItemModel &model = *registers()->model();
        const QModelIndexList found =
            model.match(model.index(0, RegisterModel::Name), Qt::DisplayRole, name, 1,
                        Qt::MatchExactly | Qt::MatchRecursive);
        QVERIFY2(!found.isEmpty(), qPrintable(name));
        registers()->setCurrentIndex(found.front());
    }

    void searchAll(const QString &text) const
    {
        m_dialog->search(text);
        const auto *reader = m_dialog->findChild<LibraryReader *>();
        QTRY_VERIFY(reader->isDone());
    }

private slots:
    void init()
    {
        QSettings().clear();
        m_catalog = test::builtInCatalog();
        m_refused.clear();
    }
    void cleanup() { m_dialog.reset(); }

    void showsTheRegistersOfAModelByAddress()
    {
        open();
        m_dialog->showModel(1200, -1);
        QCOMPARE(modelShown(), u"XL330-M288"_s);
        const ControlTablePtr table = m_catalog.find(1200, 255);
        registers()->expandAll();
        QCOMPARE(rows(*registers(), {RegisterModel::Name}).size(), qsizetype(table->fields().size()) + 2); // two runs
        const QStringList lines =
            rows(*registers(), {RegisterModel::Address, RegisterModel::Name, RegisterModel::Size,
                                RegisterModel::AreaColumn, RegisterModel::AccessColumn, RegisterModel::Default,
                                RegisterModel::Range, RegisterModel::UnitColumn});
        QCOMPARE(lines.front(), u"0|Model Number|2|EEPROM|R|1200||"_s);
        QVERIFY(lines.contains(u"38|Current Limit|2|EEPROM|RW|1750|0 … 1750|mA"_s));
        QVERIFY(lines.contains(u"102|Goal Current|±2|RAM|RW||−Current Limit … Current Limit|mA"_s));
        QVERIFY(lines.contains(u"20|Homing Offset|±4|EEPROM|RW|0|−1044479 … 1044479|pulse"_s));
    }

    void aPageSaysAll_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<QString>("name");
        QTest::addColumn<QStringList>("says");
        QTest::newRow("limits that are registers")
            << 1020 << u"Goal Current"_s
            << QStringList{u"address 102 (0x66) · 2 bytes, signed · RAM · read and write"_s,
                           u"Range −Current Limit … Current Limit, from the factory −1193 … 1193 (−3209 mA … "
                           "3209 mA)"_s,
                           u"One step is 2.69 mA"_s};
        QTest::newRow("position") << 1020 << u"Present Position"_s << QStringList{u"One step is 1 pulse, 0.08789 °"_s};
        QTest::newRow("values") << 1020 << u"Operating Mode"_s
                                << QStringList{u"Current-based position control"_s, u"A write here also resets"_s,
                                               u"It can be written only while torque is off."_s};
        QTest::newRow("bits") << 1020 << u"Drive Mode"_s << QStringList{u"bit 2"_s, u"Time-based profile"_s};
        QTest::newRow("alternates of a bit")
            << 1020 << u"Profile Velocity"_s
            << QStringList{u"While Drive Mode has Time-based profile: range 0 … 32737, in ms."_s};
        QTest::newRow("alternates of values")
            << 1020 << u"Goal Position"_s
            << QStringList{u"While Operating Mode is Extended position control or Current-based position control: "
                           "range −1048575 … 1048575."_s};
        QTest::newRow("special values") << 1020 << u"Bus Watchdog"_s << QStringList{u"Off"_s, u"Triggered"_s};
        QTest::newRow("firmware") << 1020 << u"Backup Ready"_s << QStringList{u"Not in firmware 44 and older."_s};
        QTest::newRow("other bits") << 1020 << u"Drive Mode"_s
                                    << QStringList{
                                           u"Not in firmware 37 and older."_s,
                                           u"In firmware 42 to 44: range 0 … 5, without “Torque on by goal”."_s};
        QTest::newRow("doubt") << 4000 << u"Present Input Voltage"_s
                               << QStringList{u"Doubtful: 0.01 V in every manual"_s};
        QTest::newRow("direction bit") << 350 << u"Present Speed"_s << QStringList{u"Bit 10 is the direction"_s};
        QTest::newRow("gear")
            << 4030 << u"Goal Position"_s
            << QStringList{u"Turns follow Electronic GearRatio Numerator and Electronic GearRatio Denominator"_s};
        QTest::newRow("torque") << 4030 << u"Goal Current"_s << QStringList{u"0.04 Nm as torque"_s};
    }

    void aPageSaysAll()
    {
        QFETCH(int, model);
        QFETCH(QString, name);
        QFETCH(QStringList, says);
        open();
        m_dialog->showModel(model, -1);
        selectRegister(name);
        for (const QString &sentence : says)
            QVERIFY2(page().contains(sentence), qPrintable(page()));
    }

    void aPageFollowsTheUnits()
    {
        open();
        m_dialog->setUnits(AngleUnit::Radians);
        m_dialog->showModel(1020, -1);
        m_dialog->showRegister(u"Homing Offset"_s);
        QVERIFY2(page().contains(u" rad)"_s), qPrintable(page()));
        m_dialog->setUnits(AngleUnit::Degrees);
        QVERIFY(!page().contains(u" rad)"_s));
        QVERIFY2(page().contains(u" °)"_s), qPrintable(page()));
    }

    void firmwareIsChosenAndItsDifferencesMarked()
    {
        open();
        m_dialog->showModel(1200, 52);
        auto *firmware = find<QComboBox>("libraryFirmware");
        QVERIFY(firmware->isVisible());
        QCOMPARE(firmware->currentText(), u"Firmware 46 to 52"_s);
        registers()->expandAll();
        QVERIFY(
            rows(*registers(), {RegisterModel::Name, RegisterModel::Firmware}).contains(u"Indirect Data 1|differs"_s));
        QVERIFY(facts().contains(u"Not in this firmware: "_s)
                && facts().contains(u"Indirect Address 21 to 28 (208): firmware 53 and newer"_s));
        selectRegister(u"Indirect Address 1"_s);
        QVERIFY2(page().contains(u"In firmware 53 and newer: default 224, range 64 … 251."_s), qPrintable(page()));
        firmware->setCurrentIndex(firmware->count() - 1);
        emit firmware->activated(firmware->count() - 1);
        QCOMPARE(textOf(registers()->currentIndex().siblingAtColumn(RegisterModel::Name)), u"Indirect Address 1"_s);
        registers()->expandAll();
        QVERIFY(rows(*registers(), {RegisterModel::Name, RegisterModel::Firmware})
                    .contains(u"Indirect Address 28|since 53"_s));
        m_dialog->showModel(350, -1); // one table only
        QVERIFY(!firmware->isVisible());
        QVERIFY(registers()->isColumnHidden(RegisterModel::Firmware));
    }

    void modelsAreFiltered_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QStringList>("left");
        QTest::newRow("name") << u"xm430"_s << QStringList{u"X"_s, u"XM430-W210"_s, u"XM430-W350"_s};
        QTest::newRow("number") << u"1060"_s << QStringList{u"X"_s, u"XL430-W250"_s};
        QTest::newRow("another name") << u"XC430-T240BB"_s << QStringList{u"X"_s, u"XC430-W240"_s};
        QTest::newRow("series") << u"MX"_s
                                << QStringList{u"MX(2.0)"_s, u"MX-106(2.0)"_s, u"MX-28(2.0)"_s, u"MX-64(2.0)"_s};
    }
    void modelsAreFiltered()
    {
        QFETCH(QString, text);
        open();
        find<QLineEdit>("modelFilter")->setText(text);
        QTEST(rows(*find<QTreeView>("modelView"), {0}), "left");
    }

    void theFilterLeadsToTheModel()
    {
        open();
        auto *filter = find<QLineEdit>("modelFilter");
        filter->setFocus();
        QTest::keyClicks(filter, u"xl-320"_s);
        QTest::keyClick(filter, Qt::Key_Return);
        QCOMPARE(modelShown(), u"XL-320"_s);
        QVERIFY(find<QTreeView>("modelView")->hasFocus());
        m_dialog->showModel(1020, -1); // which the filter hides
        QCOMPARE(modelShown(), u"XM430-W350"_s);
        QVERIFY(filter->text().isEmpty());
        filter->setText(u"AX-12"_s);
        QVERIFY(find<QLabel>("modelsEmpty")->isVisible());
        QVERIFY(find<QLabel>("modelsEmpty")->text().contains(u"“AX-12”"_s));
    }

    void searchesInOneModel()
    {
        open();
        m_dialog->showModel(1020, -1);
        search()->setText(u"current"_s);
        const QStringList found = rows(*registers(), {RegisterModel::Name});
        QVERIFY(found.contains(u"Goal Current"_s) && !found.contains(u"LED"_s));
        search()->setText(u"0x66"_s);
        QCOMPARE(rows(*registers(), {RegisterModel::Name}), QStringList{u"Goal Current"_s});
        search()->setText(u"pressure"_s);
        QVERIFY(find<QLabel>("libraryNothing")->isVisible());
        QVERIFY(find<QLabel>("libraryNothing")->text().contains(u"“pressure”"_s));
        QVERIFY(page().isEmpty());
    }

    void searchesInAllModels()
    {
        open();
        searchAll(u"Goal Current"_s);
        const QStringList found = rows(*results(), {SearchModel::Name, SearchModel::Address});
        QCOMPARE(found.front(), u"Goal Current|102 (0x66)"_s);
        QVERIFY(found.contains(u"Goal Current|550 (0x226)"_s));
        const QModelIndex first = results()->model()->index(0, 0);
        QVERIFY(textOf(first.siblingAtColumn(SearchModel::Series)).contains(u"MX(2.0), X"_s));
        QVERIFY(results()->model()->rowCount(first) > 30);
        search()->setText(u"102"_s);
        QCOMPARE(rows(*results(), {SearchModel::Name}).front(), u"Goal Current"_s);
        search()->setText(u"0x66"_s);
        QCOMPARE(rows(*results(), {SearchModel::Name}).front(), u"Goal Current"_s);
        search()->setText(u"Goal Pressure"_s);
        QVERIFY(find<QLabel>("libraryNothing")->text().contains(u"“Goal Pressure”"_s));
        search()->clear();
        QVERIFY(find<QLabel>("libraryNothing")->text().startsWith(u"Type a register's name"_s));
    }

    /// From a find to the model's table, at that register and firmware; and back to what was searched.
    void aFindIsOpened()
    {
        open();
        m_dialog->showModel(350, -1);
        searchAll(u"Acceleration Limit"_s);
        const QModelIndexList at40 = results()->model()->match(results()->model()->index(0, SearchModel::Address),
                                                               Qt::DisplayRole, u"40 (0x28)"_s, 1);
        QVERIFY(!at40.isEmpty());
        const QModelIndex first = at40.front().siblingAtColumn(SearchModel::Name);
        const QModelIndexList xm430 =
            results()->model()->match(results()->model()->index(0, 0, first), Qt::DisplayRole, u"XM430-W350"_s, 1);
        QVERIFY(!xm430.isEmpty());
        QCOMPARE(textOf(xm430.front().siblingAtColumn(SearchModel::Models)), u"firmware 37 and older"_s);
        results()->expand(first);
        results()->setCurrentIndex(xm430.front());
        QVERIFY(page().startsWith(u"XM430-W350:"_s));
        results()->setFocus();
        QTest::keyClick(results(), Qt::Key_Return);
        QCOMPARE(modelShown(), u"XM430-W350"_s);
        QCOMPARE(find<QComboBox>("libraryFirmware")->currentText(), u"Firmware 37 and older"_s);
        QCOMPARE(textOf(registers()->currentIndex().siblingAtColumn(RegisterModel::Name)), u"Acceleration Limit"_s);
        QVERIFY(registers()->hasFocus() && search()->text().isEmpty());
        QTest::keyClick(m_dialog.get(), Qt::Key_2, Qt::AltModifier);
        QCOMPARE(search()->text(), u"Acceleration Limit"_s);
        QTest::keyClick(m_dialog.get(), Qt::Key_1, Qt::AltModifier);
        QCOMPARE(modelShown(), u"XM430-W350"_s);
        QVERIFY(search()->text().isEmpty());
    }

    /// As in the grid of a device: nobody reads 28 rows of Indirect Address one by one.
    void longRunsAreFolded()
    {
        open();
        m_dialog->showModel(1020, -1);
        const auto shown = [this] { return rows(*registers(), {RegisterModel::Address, RegisterModel::Name}); };
        QVERIFY(shown().contains(u"168|Indirect Address 1 – 28"_s));
        QVERIFY(!shown().contains(u"168|Indirect Address 1"_s));
        search()->setText(u"indirect address 3"_s);
        QVERIFY(shown().contains(u"172|Indirect Address 3"_s));
        search()->clear();
        QVERIFY(!shown().contains(u"168|Indirect Address 1"_s));
        m_dialog->showRegister(u"Indirect Address 2"_s);
        QVERIFY(shown().contains(u"170|Indirect Address 2"_s));
        QVERIFY(page().contains(u"Indirect Address 2"_s));
    }

    /// What differs stays readable however narrow the list is.
    void namesThatLookAlike_data()
    {
        QTest::addColumn<QStringList>("names");
        QTest::addColumn<QStringList>("brief"); // empty: whole
        QTest::newRow("alike") << QStringList{u"HX5 sync table 1 device 1"_s, u"HX5 sync table 2 device 1"_s}
                               << QStringList{u"… 1 device 1"_s, u"… 2 device 1"_s};
        QTest::newRow("alone") << QStringList{u"HX5 sync table 1 device 1"_s, u"HX5-D20-RR"_s}
                               << QStringList{QString(), QString()};
        QTest::newRow("one word") << QStringList{u"XM430-W210"_s, u"XM430-W350"_s} << QStringList{QString(), QString()};
    }

    void namesThatLookAlike()
    {
        QFETCH(QStringList, names);
        QTEST(shortNames(names), "brief");
    }

    void rowsAreCopied()
    {
        open();
        m_dialog->showModel(1200, -1);
        selectRegister(u"Goal Current"_s);
        registers()->setFocus();
        QTest::keyClick(registers(), Qt::Key_C, Qt::ControlModifier);
        const QString text = QGuiApplication::clipboard()->text();
        QCOMPARE(text.count(u'\n'), 2);
        QVERIFY(text.startsWith(u"Address\tRegister\tSize\t"_s));
        QVERIFY2(text.contains(u"\n102\tGoal Current\t±2\tRAM\tRW\t\t-Current Limit … Current Limit\tmA\t"_s),
                 qPrintable(text));
        registers()->clearSelection();
        find<QToolButton>("libraryCopy")->click();
        QCOMPARE(QGuiApplication::clipboard()->text().count(u'\n'), qsizetype(m_catalog.find(1200, 255)->fields().size()) + 1);
    }

    void keysLeadFromTheSearchToTheList()
    {
        open();
        m_dialog->showModel(1020, -1);
        QTest::keyClick(m_dialog.get(), Qt::Key_F, Qt::ControlModifier);
        QVERIFY(search()->hasFocus());
        QTest::keyClicks(search(), u"voltage"_s);
        QTest::keyClick(search(), Qt::Key_Down);
        QVERIFY(registers()->hasFocus());
        QVERIFY(registers()->currentIndex().isValid());
        QVERIFY(page().contains(u"Voltage"_s));
    }

    void onesOwnTablesAndRefusedFiles()
    {
        const QByteArray own =
            "{ \"format\": 2, \"extends\": \"x330\", \"series\": \"Mine\", \"registers\": { \"LED\": "
            "{ \"help\": \"<b>bold</b> & loud\" } }, \"models\": { \"Own <i>1</i>\": { \"number\": 9001, "
            "\"alsoCalled\": [\"Second\"] } } }";
        QVERIFY(m_catalog.add(own, u"/tables/own.json"_s));
        m_refused.push_back(
            {{ErrorKind::BadFile, u"/tables/bad.json: line 3: Own: LED: unknown unit \"<lux>\""_s, 0}, u"bad.json"_s});
        open();
        m_dialog->showModel(9001, -1);
        QCOMPARE(modelShown(), u"Own <i>1</i>"_s);
        QVERIFY(facts().contains(u"your own, own.json in "_s) && facts().contains(u"Also called Second"_s));
        selectRegister(u"LED"_s);
        QVERIFY(page().contains(u"<b>bold</b> & loud"_s)); // as written, not obeyed
        auto *models = find<QTreeView>("modelView");
        const QModelIndexList bad = models->model()->match(models->model()->index(0, 0), Qt::DisplayRole, u"bad.json"_s,
                                                           1, Qt::MatchExactly | Qt::MatchRecursive);
        QCOMPARE(bad.size(), 1);
        QCOMPARE(textOf(bad.front().parent()), u"Files not read"_s);
        models->setCurrentIndex(bad.front());
        QCOMPARE(modelShown(), u"bad.json"_s);
        QVERIFY2(facts().contains(u"/tables/bad.json: line 3: Own: LED: unknown unit &quot;&lt;lux&gt;&quot;"_s),
                 qPrintable(facts()));
        QCOMPARE(registers()->model()->rowCount(), 0);
        m_dialog->showModel(1020, -1);
        QVERIFY(registers()->isVisible() && find<QTextBrowser>("libraryPage")->isVisible());
    }

    void remembersTheModel()
    {
        open();
        QCOMPARE(modelShown(), u"XM430-W350"_s);
        m_dialog->showModel(350, -1);
        m_dialog->reject();
        open();
        QCOMPARE(modelShown(), u"XL-320"_s);
    }

    void theWindowOpensItAtTheSelectedDevice()
    {
        test::WorkbenchFixture bench;
        MainWindow window(bench.workbench());
        window.show();
        window.setRefusedTables({{{ErrorKind::BadFile, u"/tables/bad.json: line 3: no"_s, 0}, u"bad.json"_s}});
        window.connectTo(u"sim"_s, 1000000);
        QTRY_COMPARE(bench.session.devices().size(), std::size_t(3));
        QTRY_VERIFY(!bench.scanner.isRunning());
        auto *panel = window.findChild<DevicePanel *>();
        panel->selectDevice(bench.device(4, 1000000));
        auto *action = window.findChild<QAction *>(u"libraryAction"_s);
        action->trigger();
        auto *dialog = window.findChild<LibraryDialog *>();
        QVERIFY(dialog && dialog->isVisible() && !dialog->isModal());
        QCOMPARE(dialog->findChild<QLabel *>(u"libraryModel"_s)->text(), u"XL430-W250"_s);
        const QAbstractItemModel &models = *dialog->findChild<QTreeView *>(u"modelView"_s)->model();
        QVERIFY(!models.match(models.index(0, 0), Qt::DisplayRole, u"bad.json"_s, 1, Qt::MatchRecursive).isEmpty());
        action->trigger();
        QCOMPARE(window.findChildren<LibraryDialog *>().size(), 1);
    }
};

DYNASCOPE_UI_TEST(TestLibrary)
#include "tst_library.moc"
