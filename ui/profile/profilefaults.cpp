// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/profile/profilefaults.h"

#include "ui/common/texts.h"

#include <QFileInfo>
#include <QLabel>
#include <QPlainTextEdit>
#include <QRegularExpression>
#include <QVBoxLayout>

namespace dynascope {

ProfileFaults::ProfileFaults(QWidget *parent)
    : QWidget(parent), m_title(new QLabel(this)), m_list(new QPlainTextEdit(this))
{
    m_title->setTextFormat(Qt::PlainText);
    m_list->setObjectName(QStringLiteral("profileFaults"));
    m_list->setAccessibleName(tr("What is wrong with the file"));
    m_list->setReadOnly(true);
    m_list->setTabChangesFocus(true);
    m_list->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(8);
    layout->addWidget(m_title);
    layout->addWidget(m_list, 1);
}

void ProfileFaults::show(const QString &path, const QString &text)
{
    static const QRegularExpression place(QStringLiteral("^(\\d+):(\\d+): (.*)$"));
    const QString before = path + u':';
    QStringList lines;
    for (QString line : text.split(u'\n', Qt::SkipEmptyParts)) {
        if (line.startsWith(before))
            line.remove(0, before.size());
        const QRegularExpressionMatch match = place.match(line);
        lines << (match.hasMatch() ? tr("Line %1, column %2: %3").arg(match.captured(1), match.captured(2), match.captured(3))
                                   : line);
    }
    m_title->setText(lines.size() == 1 ? tr("%1 can't be used:").arg(QFileInfo(path).fileName())
                                       : tr("%1 can't be used, for %2 reasons:")
                                             .arg(QFileInfo(path).fileName())
                                             .arg(lines.size()));
    if (m_list->toPlainText() != lines.join(u'\n')) // what is selected stays so
        m_list->setPlainText(lines.join(u'\n'));
}

} // namespace dynascope
