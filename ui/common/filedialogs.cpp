// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/common/filedialogs.h"

#include <QCoreApplication>
#include <QFileDialog>

namespace dynascope {

QFileDialog *makeSaveDialog(QWidget *parent, const QString &title, const QString &suffix, const QString &suggested)
{
    auto *dialog = new QFileDialog(parent, title);
    dialog->setObjectName(QStringLiteral("saveDialog"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setOption(QFileDialog::DontUseNativeDialog);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setDefaultSuffix(suffix);
    dialog->setNameFilter(QCoreApplication::translate("FileDialogs", "%1 files (*.%2)").arg(suffix.toUpper(), suffix));
    dialog->selectFile(suggested);
    return dialog;
}

} // namespace dynascope
