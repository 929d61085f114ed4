// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/modeldelegate.h"

#include <algorithm>
#include <map>

namespace dynascope {
namespace {

constexpr qsizetype LeastShared = 2; ///< words
constexpr int TextMargins = 10;      ///< what a style leaves free beside a text

qsizetype sharedWords(const QStringList &one, const QStringList &other)
{
    const qsizetype most = std::min(one.size(), other.size());
    qsizetype count = 0;
    while (count < most && one[count] == other[count])
        ++count;
    return count;
}

} // namespace

void ModelDelegate::initStyleOption(QStyleOptionViewItem *option, const QModelIndex &index) const
{
    QStyledItemDelegate::initStyleOption(option, index);
    const QVariant brief = index.data(ShortRole);
    const int icon = option->icon.isNull() ? 0 : option->decorationSize.width() + TextMargins / 2;
    const int room = option->rect.width() - icon - TextMargins;
    if (brief.isValid() && option->fontMetrics.horizontalAdvance(option->text) > room)
        option->text = brief.toString();
}

QStringList shortNames(const QStringList &names)
{
    struct Like {
        QStringList words; ///< of the first
        qsizetype shared = 0;
        int count = 0;
    };
    std::map<QString, Like> likes; // by the first words
    const auto key = [](const QStringList &words) { return words.mid(0, LeastShared).join(u' '); };
    for (const QString &name : names) {
        const QStringList words = name.split(u' ');
        Like &like = likes[key(words)];
        like.shared = like.count++ == 0 ? words.size() : std::min(like.shared, sharedWords(like.words, words));
        if (like.count == 1)
            like.words = words;
    }
    QStringList brief;
    for (const QString &name : names) {
        const QStringList words = name.split(u' ');
        const Like &like = likes[key(words)];
        const bool isLess = like.count > 1 && like.shared >= LeastShared && like.shared < words.size();
        brief << (isLess ? QStringLiteral("… ") + words.mid(like.shared).join(u' ') : QString());
    }
    return brief;
}

} // namespace dynascope
