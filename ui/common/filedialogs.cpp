// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/common/filedialogs.h"

#include "ui/common/present.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>

namespace dynascope {

namespace {

class SaveDialog final : public QFileDialog
{
public:
    using QFileDialog::QFileDialog;

    void accept() override
    {
        const QString path = selectedFiles().value(0);
        if (!QFileInfo(path).isFile() || path == m_agreed)
            return QFileDialog::accept();
        askToReplace(path);
    }

private:
    void askToReplace(const QString &path)
    {
        const QString name = QStringLiteral("replaceBox");
        if (raiseOpen(*this, name, path))
            return;
        auto *box = new QMessageBox(QMessageBox::Warning, windowTitle(),
                                    QCoreApplication::translate("FileDialogs", "%1 is there already. Replace it?")
                                        .arg(QDir::toNativeSeparators(path)),
                                    QMessageBox::Cancel, this);
        box->setObjectName(name);
        box->setTextFormat(Qt::PlainText);
        QPushButton *replace =
            box->addButton(QCoreApplication::translate("FileDialogs", "Replace"), QMessageBox::AcceptRole);
        replace->setObjectName(QStringLiteral("replaceButton"));
        connect(replace, &QPushButton::clicked, this, [this, path] {
            m_agreed = path; // asked for another name meanwhile, it asks again
            accept();
        });
        present(*box, path);
    }

    QString m_agreed; ///< a file that may be replaced
};

/// Where one of this kind was chosen last; else in `first`.
void beginIn(QFileDialog &dialog, const QString &kind, const QString &first = {})
{
    const QString key = QStringLiteral("folders/") + kind;
    const QString last = QSettings().value(key, first).toString();
    if (!last.isEmpty() && QFileInfo(last).isDir())
        dialog.setDirectory(last);
    QObject::connect(&dialog, &QFileDialog::fileSelected, &dialog,
                     [key](const QString &path) { QSettings().setValue(key, QFileInfo(path).absolutePath()); });
}

} // namespace

void askWhereToSave(QWidget *parent, const QString &title, const QString &suffix, const QString &suggested,
                    std::function<void(const QString &path)> save)
{
    const QString name = QStringLiteral("saveDialog");
    if (raiseOpen(*parent, name, suffix))
        return;
    auto *dialog = new SaveDialog(parent, title);
    dialog->setObjectName(name);
    dialog->setOption(QFileDialog::DontUseNativeDialog);
    dialog->setOption(QFileDialog::DontConfirmOverwrite);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setDefaultSuffix(suffix);
    dialog->setNameFilter(QCoreApplication::translate("FileDialogs", "%1 files (*.%2)").arg(suffix.toUpper(), suffix));
    beginIn(*dialog, suffix);
    dialog->selectFile(suggested);
    QObject::connect(dialog, &QFileDialog::fileSelected, parent, std::move(save));
    present(*dialog, suffix);
}

void askWhatToOpen(QWidget *parent, const QString &title, const QStringList &suffixes,
                   std::function<void(const QString &path)> open, const QString &usualFolder)
{
    const QString name = QStringLiteral("openDialog");
    if (raiseOpen(*parent, name, title))
        return;
    auto *dialog = new QFileDialog(parent, title);
    dialog->setObjectName(name);
    dialog->setOption(QFileDialog::DontUseNativeDialog);
    dialog->setAcceptMode(QFileDialog::AcceptOpen);
    dialog->setFileMode(QFileDialog::ExistingFile);
    QStringList patterns;
    for (const QString &suffix : suffixes)
        patterns << QStringLiteral("*.") + suffix;
    dialog->setNameFilters({QCoreApplication::translate("FileDialogs", "%1 files (%2)")
                                .arg(suffixes.value(0).toUpper(), patterns.join(u' ')),
                            QCoreApplication::translate("FileDialogs", "All files (*)")});
    beginIn(*dialog, suffixes.value(0), usualFolder);
    QObject::connect(dialog, &QFileDialog::fileSelected, parent, std::move(open));
    present(*dialog, title);
}

void askForFolder(QWidget *parent, const QString &title, std::function<void(const QString &path)> take)
{
    const QString name = QStringLiteral("folderDialog");
    if (raiseOpen(*parent, name, title))
        return;
    auto *dialog = new QFileDialog(parent, title);
    dialog->setObjectName(name);
    dialog->setOption(QFileDialog::DontUseNativeDialog);
    dialog->setOption(QFileDialog::ShowDirsOnly);
    dialog->setFileMode(QFileDialog::Directory);
    beginIn(*dialog, QStringLiteral("folder"));
    QObject::connect(dialog, &QFileDialog::fileSelected, parent, std::move(take));
    present(*dialog, title);
}

} // namespace dynascope
