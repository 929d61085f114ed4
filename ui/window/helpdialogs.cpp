// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/helpdialogs.h"

#include "ui/common/icons.h"
#include "ui/common/present.h"

#include <QAction>
#include <QCoreApplication>
#include <QDialogButtonBox>
#include <QHeaderView>
#include <QMainWindow>
#include <QMessageBox>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <map>

namespace dynascope {

namespace {

/// The context of what is translated here.
class Help
{
    Q_DECLARE_TR_FUNCTIONS(Help)
};

QString plainText(const QAction &action)
{
    QString text = action.text().section(QLatin1Char('\t'), 0, 0);
    text.remove(QLatin1Char('&'));
    text.remove(QChar(0x2026));
    return text;
}

} // namespace

void showShortcuts(QMainWindow &window)
{
    const QString name = QStringLiteral("shortcutsDialog");
    if (raiseOpen(window, name))
        return;
    auto *dialog = new QDialog(&window);
    dialog->setObjectName(name);
    dialog->setWindowTitle(Help::tr("Keyboard shortcuts"));
    auto *list = new QTreeWidget(dialog);
    list->setColumnCount(2);
    list->setHeaderLabels({Help::tr("Action"), Help::tr("Keys")});
    list->setRootIsDecorated(false);
    list->setAlternatingRowColors(true);
    list->setSelectionMode(QAbstractItemView::NoSelection);
    list->setAccessibleName(Help::tr("Keyboard shortcuts"));

    std::map<QString, QString> keys; // by name, each once
    for (const QAction *action : window.findChildren<QAction *>()) {
        if (!action->shortcut().isEmpty() && !action->text().isEmpty())
            keys[plainText(*action)] = action->shortcut().toString(QKeySequence::NativeText);
    }
    const auto addRow = [list](const QString &text, const QString &key) {
        auto *item = new QTreeWidgetItem(list, {text, key});
        item->setSizeHint(0, QSize(0, list->fontMetrics().height() + 8));
    };
    addRow(Help::tr("STOP: torque off everywhere, at once"), Help::tr("Esc, anywhere"));
    for (const auto &[text, key] : keys)
        addRow(text, key);
    list->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    list->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
    list->header()->setStretchLastSection(false);

    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Close, dialog);
    QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
    auto *layout = new QVBoxLayout(dialog);
    layout->setContentsMargins(16, 16, 16, 16);
    layout->addWidget(list);
    layout->addWidget(buttons);
    dialog->resize(460, 520);
    present(*dialog);
}

void showAbout(QMainWindow &window)
{
    const QString name = QStringLiteral("aboutBox");
    if (raiseOpen(window, name))
        return;
    auto *box = new QMessageBox(&window);
    box->setObjectName(name);
    box->setWindowTitle(Help::tr("About Dynascope"));
    box->setIconPixmap(applicationIcon().pixmap(QSize(64, 64), window.devicePixelRatioF()));
    box->setTextFormat(Qt::PlainText);
    const QString version = QCoreApplication::applicationVersion();
    box->setText(version.isEmpty() ? Help::tr("Dynascope") : Help::tr("Dynascope %1").arg(version));
    box->setInformativeText(
        Help::tr("An open workbench for DYNAMIXEL servos, Protocol 2.0.\n\n"
           "Free software under the GNU General Public License, version 3 or later. It comes without any "
           "warranty.\n\nDYNAMIXEL is a trademark of ROBOTIS Co., Ltd., which has no part in this program."));
    present(*box);
}

} // namespace dynascope
