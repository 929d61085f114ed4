// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/tablewindow.h"
#include "ui/table/fieldgroups.h"

#include <QCompleter>
#include <QLabel>
#include <QLineEdit>

using namespace dynascope;
using namespace Qt::StringLiterals;

/// Indirect registers, and other long runs of like ones.
class TestTableIndirect : public QObject
{
    Q_OBJECT

    static QString text(const TableWindow &window, const QString &name)
    {
        return window.cell(name, ColumnKind::Physical).data().toString();
    }

private slots:
    void saysWhatItPointsAt_data()
    {
        QTest::addColumn<int>("address");
        QTest::addColumn<QString>("points");
        QTest::addColumn<QString>("data");
        QTest::newRow("first byte") << 132 << "→ Present Position, byte 0"
                                    << "of Present Position, byte 0";
        QTest::newRow("another byte") << 135 << "→ Present Position, byte 3"
                                      << "of Present Position, byte 3";
        QTest::newRow("only byte") << 65 << "→ LED"
                                   << "of LED";
        QTest::newRow("no register") << 150 << "→ 150"
                                     << "of 150";
        QTest::newRow("itself, as from the factory") << 224 << "→ Indirect Data 1 (not assigned)"
                                                     << "not assigned";
        QTest::newRow("another's data") << 225 << "→ Indirect Data 2"
                                        << "of Indirect Data 2";
    }

    void saysWhatItPointsAt()
    {
        QFETCH(int, address);
        TableFixture fixture;
        TableWindow window(fixture);
        Device *device = fixture.add(1);
        window.panel.setDevices({device});
        TableFixture::set(device, QStringLiteral("Indirect Address 1"), address);
        QTEST(text(window, QStringLiteral("Indirect Address 1")), "points");
        QTEST(text(window, QStringLiteral("Indirect Data 1")), "data");
    }

    void dataFollowsItsAddress()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        Device *device = fixture.add(1);
        window.panel.setDevices({device});
        const QPersistentModelIndex data = window.cell(QStringLiteral("Indirect Data 1"), ColumnKind::Physical);
        int told = 0;
        connect(window.view->model(), &QAbstractItemModel::dataChanged, this,
                [&](const QModelIndex &first, const QModelIndex &last) {
                    told += first.parent() == data.parent() && first.row() <= data.row() && data.row() <= last.row();
                });
        TableFixture::set(device, QStringLiteral("Indirect Address 1"), 132);
        QTRY_VERIFY(told > 0);
    }

    void takesARegisterOrAnAddress_data()
    {
        QTest::addColumn<QString>("typed");
        QTest::addColumn<QString>("written");
        QTest::newRow("name") << "present current"
                              << "Indirect Address 1=126";
        QTest::newRow("byte") << "Present Current, byte 1"
                              << "Indirect Address 1=127";
        QTest::newRow("address") << "132"
                                 << "Indirect Address 1=132";
        QTest::newRow("untouched") << ""
                                   << "";
    }

    void takesARegisterOrAnAddress()
    {
        QFETCH(QString, typed);
        QFETCH(QString, written);
        TableFixture fixture;
        TableWindow window(fixture);
        Device *device = fixture.add(1);
        window.panel.setDevices({device});
        TableFixture::set(device, QStringLiteral("Indirect Address 1"), 134);
        openGroup(window, QStringLiteral("Indirect addresses"));
        window.go(QStringLiteral("Indirect Address 1"), ColumnKind::Name);
        QTest::keyClick(window.view, Qt::Key_Return);
        QVERIFY(window.edit());
        QCOMPARE(window.edit()->text(), QStringLiteral("Present Position, byte 2"));
        QVERIFY(window.edit()->completer());
        if (!typed.isEmpty())
            window.edit()->setText(typed);
        QTest::keyClick(window.edit(), Qt::Key_Return);
        QTRY_VERIFY(!window.edit());
        QCOMPARE(fixture.written(), written.isEmpty() ? QStringList() : QStringList{QStringLiteral("1 ") + written});
    }

    void refusesWhatIsntThere()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        window.panel.setDevices({fixture.add(1)});
        openGroup(window, QStringLiteral("Indirect addresses"));
        window.go(QStringLiteral("Indirect Address 1"));
        QTest::keyClick(window.view, Qt::Key_Return);
        for (const char *typed : {"Present Weather", "Present Current, byte 2", "9", "70000"}) {
            window.edit()->setText(QString::fromLatin1(typed));
            QTest::keyClick(window.edit(), Qt::Key_Return);
            QVERIFY2(window.edit() && window.edit()->isVisible(), typed);
        }
        QCOMPARE(fixture.written(), QStringList());
    }

    void longRunsAreFoldedAndSayHowMany()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        window.panel.setDevices({fixture.add(1, 4000)}); // Y
        QStringList groups;
        for (int row = 0; row < window.view->model()->rowCount(); ++row) {
            const QModelIndex group = window.view->model()->index(row, 0);
            groups << QStringLiteral("%1 %2%3").arg(window.view->isExpanded(group) ? u"-"_s : u"+"_s,
                                                    group.data().toString(),
                                                    group.data(GroupHintRole).toString().prepend(u'|'));
        }
        QCOMPARE(groups,
                 (QStringList{u"- EEPROM|"_s, u"- Hybrid|"_s, u"- RAM|"_s, u"+ Error Code History|16 registers"_s,
                              u"+ Indirect addresses|128 registers"_s, u"+ Indirect data|128 registers"_s}));
    }

    void everyRegisterIsInOneGroup()
    {
        for (const Catalog::ModelInfo &info : TableFixture::catalog().models()) {
            const ControlTablePtr table = TableFixture::catalog().find(info.modelNumber, 255);
            std::vector<int> seen(table->fields().size(), 0);
            for (const FieldGroup &group : fieldGroups(*table)) {
                QVERIFY(std::ranges::is_sorted(group.fields));
                for (const int field : group.fields)
                    ++seen[std::size_t(field)];
            }
            QVERIFY2(std::ranges::all_of(seen, [](int count) { return count == 1; }), qPrintable(info.model));
        }
    }

    void searchFindsInside()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        window.panel.setDevices({fixture.add(1)});
        window.find<QLineEdit>("tableSearch")->setText(QStringLiteral("indirect data 30"));
        const QModelIndex found = window.cell(QStringLiteral("Indirect Data 30"), ColumnKind::Name);
        QVERIFY(found.isValid());
        QVERIFY(window.view->isExpanded(found.parent()));
    }

    void onlyWhatIsUnfoldedIsPolled()
    {
        TableFixture fixture;
        TableActions actions = fixture.actions();
        std::set<Watch> unfolded{{0, -1}};
        actions.setUnfolded = [&](const std::set<Watch> &fields) { unfolded = fields; };
        TablePanel panel(actions);
        panel.show();
        Device *device = fixture.add(1);
        panel.setDevices({device});
        QVERIFY(unfolded.empty());
        auto *view = panel.findChild<TableView *>();
        const QModelIndexList data =
            view->model()->match(view->model()->index(0, 0), Qt::DisplayRole, QStringLiteral("Indirect data"));
        view->expand(data.front());
        QCOMPARE(unfolded.size(), std::size_t(56));
        QVERIFY(unfolded.contains({device->key(), TableFixture::field(device, u"Indirect Data 56")}));
        // A search shows a few of them.
        panel.findChild<QLineEdit *>(QStringLiteral("tableSearch"))->setText(QStringLiteral("indirect data 30"));
        QVERIFY(unfolded.contains({device->key(), TableFixture::field(device, u"Indirect Data 30")}));
        QVERIFY(unfolded.size() < 5);
        panel.findChild<QLineEdit *>(QStringLiteral("tableSearch"))->clear();
        view->collapse(
            view->model()->match(view->model()->index(0, 0), Qt::DisplayRole, QStringLiteral("Indirect data")).front());
        QVERIFY(unfolded.empty());
    }

private:
    static void openGroup(TableWindow &window, const QString &title)
    {
        const QAbstractItemModel *model = window.view->model();
        for (int row = 0; row < model->rowCount(); ++row) {
            if (model->index(row, 0).data().toString() == title)
                window.view->expand(model->index(row, 0));
        }
    }
};

DYNASCOPE_UI_TEST(TestTableIndirect)
#include "tst_tableindirect.moc"
