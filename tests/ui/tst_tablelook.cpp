// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/tablefixture.h"
#include "ui/common/theme.h"
#include "ui/table/tablepanel.h"
#include "ui/table/tableview.h"

#include <QDir>
#include <QLabel>
#include <QLineEdit>
#include <QToolButton>

using namespace dynascope;

/// The panel as a picture, into the folder DYNASCOPE_PICTURES if that is set. What can be checked without eyes is
/// checked.
class TestTableLook : public QObject
{
    Q_OBJECT

    static void select(TablePanel &panel, const QString &name)
    {
        auto *view = panel.findChild<TableView *>();
        const QModelIndexList found = view->model()->match(view->model()->index(0, 0), Qt::DisplayRole, name, 1,
                                                           Qt::MatchExactly | Qt::MatchRecursive);
        QVERIFY(!found.isEmpty());
        view->setCurrentIndex(found.front());
        view->scrollTo(found.front(), QAbstractItemView::PositionAtCenter);
    }

    static void save(QWidget &widget, const QString &name, ColorScheme scheme)
    {
        QTest::qWait(50);
        const QPixmap picture = widget.grab();
        QVERIFY(!picture.isNull());
        const QString folder = qEnvironmentVariable("DYNASCOPE_PICTURES");
        if (!folder.isEmpty())
            picture.save(QDir(folder).filePath(
                name + (scheme == ColorScheme::Dark ? QStringLiteral("-dark.png") : QStringLiteral("-light.png"))));
    }

private slots:
    void looks_data()
    {
        QTest::addColumn<int>("scheme");
        QTest::newRow("light") << static_cast<int>(ColorScheme::Light);
        QTest::newRow("dark") << static_cast<int>(ColorScheme::Dark);
    }

    void looks()
    {
        QFETCH(int, scheme);
        const auto wanted = static_cast<ColorScheme>(scheme);
        applyTheme(*qApp, wanted);
        TableFixture fixture;
        Device *one = fixture.add(3);
        makeBusy(one);
        fixture.watched = {{one->key(), TableFixture::field(one, u"Present Position")}};
        TablePanel panel(fixture.actions());
        panel.resize(820, 900);
        panel.show();
        save(panel, QStringLiteral("table-empty"), wanted);
        panel.setDevices({one});
        select(panel, QStringLiteral("Operating Mode"));
        save(panel, QStringLiteral("table-top"), wanted);
        one->setFailed(TableFixture::field(one, u"Position D Gain"), QStringLiteral("nothing came back"));
        one->setPending(TableFixture::field(one, u"Profile Velocity"), 200);
        one->setPending(TableFixture::field(one, u"LED"), 1);
        QTest::qWait(250);
        select(panel, QStringLiteral("Goal Position"));
        save(panel, QStringLiteral("table-ram"), wanted);

        Device *two = fixture.add(4);
        makeBusy(two);
        TableFixture::set(two, QStringLiteral("Max Position Limit"), 4095);
        TableFixture::set(two, QStringLiteral("Drive Mode"), 4);
        panel.setDevices({one, two, fixture.add(5)});
        select(panel, QStringLiteral("Max Position Limit"));
        save(panel, QStringLiteral("table-several"), wanted);

        Device *unknown = fixture.add(9, 4711);
        panel.setDevices({unknown});
        save(panel, QStringLiteral("table-unknown"), wanted);
    }

    void editors()
    {
        TableFixture fixture;
        applyTheme(*qApp, ColorScheme::Light);
        Device *one = fixture.add(3);
        makeBusy(one);
        TablePanel panel(fixture.actions());
        panel.resize(640, 700);
        panel.setDevices({one});
        panel.show();
        auto *view = panel.findChild<TableView *>();
        select(panel, QStringLiteral("Goal Position"));
        view->startEdit(view->currentIndex());
        auto *edit = view->findChild<QLineEdit *>(QStringLiteral("valueEdit"));
        QVERIFY(edit);
        edit->setText(QStringLiteral("400"));
        save(panel, QStringLiteral("table-edit-wrong"), ColorScheme::Light);
        edit->setText(QStringLiteral("90"));
        save(panel, QStringLiteral("table-edit"), ColorScheme::Light);
        QTest::keyClick(edit, Qt::Key_Escape);
        select(panel, QStringLiteral("Max Position Limit"));
        view->startEdit(view->currentIndex());
        save(panel, QStringLiteral("table-locked"), ColorScheme::Light);
        TableFixture::set(one, QStringLiteral("Torque Enable"), 0);
        select(panel, QStringLiteral("Shutdown"));
        view->startEdit(view->currentIndex());
        QWidget *popup = view->findChild<QWidget *>(QStringLiteral("bitPopup"));
        QVERIFY(popup);
        save(*popup, QStringLiteral("table-bits"), ColorScheme::Light);
        popup->close();
    }
};

DYNASCOPE_UI_TEST(TestTableLook)
#include "tst_tablelook.moc"
