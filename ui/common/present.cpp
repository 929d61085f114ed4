// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/common/present.h"

#include <QDialog>
#include <QPointer>
#include <QVariant>

namespace dynascope {

namespace {

constexpr const char *Subject = "subject";

} // namespace

void present(QDialog &dialog, const QString &subject)
{
    dialog.setAttribute(Qt::WA_DeleteOnClose);
    dialog.setProperty(Subject, subject);
    dialog.setWindowModality(Qt::NonModal);
    dialog.show();
    dialog.raise();
    dialog.activateWindow();
}

bool raiseOpen(const QWidget &window, const QString &name, const QString &subject)
{
    for (QDialog *dialog : window.findChildren<QDialog *>(name)) {
        if (dialog->isVisible() && dialog->property(Subject).toString() == subject) {
            dialog->raise();
            dialog->activateWindow();
            return true;
        }
    }
    return false;
}

void closeDialogs(const QWidget &window)
{
    QList<QPointer<QDialog>> open;
    for (QDialog *dialog : window.findChildren<QDialog *>())
        open << dialog;
    for (const QPointer<QDialog> &dialog : open) {
        if (dialog && dialog->isVisible())
            dialog->reject();
    }
}

} // namespace dynascope
