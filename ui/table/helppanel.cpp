// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/helppanel.h"

#include "ui/common/fieldtexts.h"
#include "ui/common/icons.h"
#include "ui/common/texts.h"
#include "ui/common/theme.h"
#include "ui/table/fieldwordsmodel.h"
#include "ui/table/limitwords.h"
#include "ui/table/tableroles.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>

namespace dynascope {
namespace {

constexpr int TextHeight = 64;
constexpr int TightHeight = 34;

QString warned(const QString &text, const QPalette &palette)
{
    return QStringLiteral("<span style=\"color:%1\">%2</span>")
        .arg(colors(palette).warning.name(), text.toHtmlEscaped());
}

QString asParagraphs(const QStringList &lines)
{
    return QStringLiteral("<p style=\"margin:0 0 4px 0\">")
        + lines.join(QStringLiteral("</p><p style=\"margin:0 0 4px 0\">")) + QStringLiteral("</p>");
}

} // namespace

HelpPanel::HelpPanel(QWidget *parent)
    : QFrame(parent)
    , m_name(new QLabel(this))
    , m_facts(new QLabel(this))
    , m_text(new QLabel)
    , m_area(new QScrollArea(this))
    , m_fold(new QToolButton(this))
{
    setObjectName(QStringLiteral("helpPanel"));
    m_name->setFont(boldened(font()));
    for (QLabel *label : {m_name, m_facts})
        label->setTextFormat(Qt::PlainText);
    m_facts->setForegroundRole(QPalette::PlaceholderText);
    m_facts->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_text->setObjectName(QStringLiteral("helpText"));
    m_text->setWordWrap(true);
    m_text->setTextFormat(Qt::RichText);
    m_text->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    m_text->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_text->setContentsMargins(0, 0, 8, 0);
    m_area->setWidget(m_text);
    m_area->setWidgetResizable(true);
    m_area->setFrameShape(QFrame::NoFrame);
    m_area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_area->setFocusPolicy(Qt::NoFocus);
    m_area->setFixedHeight(TextHeight);
    m_area->viewport()->setAutoFillBackground(false);
    m_text->setAutoFillBackground(false);
    m_fold->setObjectName(QStringLiteral("helpFold"));
    m_fold->setAutoRaise(true);
    connect(m_fold, &QToolButton::clicked, this, [this] { setFolded(!m_folded); });

    auto *head = new QHBoxLayout;
    head->setSpacing(12);
    head->addWidget(m_name);
    head->addWidget(m_facts, 1);
    head->addWidget(m_fold);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(12, 4, 8, 4);
    layout->setSpacing(4);
    layout->addLayout(head);
    layout->addWidget(m_area);
    setFolded(false);
    showCell({});
}

void HelpPanel::setFolded(bool folded)
{
    m_folded = folded;
    m_area->setVisible(!folded);
    m_fold->setIcon(icon(folded ? QStringLiteral("chevron-up") : QStringLiteral("chevron-down"), IconTint::Dimmed));
    m_fold->setToolTip(folded ? tr("Show what the register is for") : tr("Fold this to one line"));
    m_fold->setAccessibleName(m_fold->toolTip());
}

void HelpPanel::setTight(bool tight)
{
    m_area->setFixedHeight(tight ? TightHeight : TextHeight);
}

void HelpPanel::setNotes(const QStringList &notes)
{
    m_notes = notes;
}

void HelpPanel::showCell(const QModelIndex &cell)
{
    const Field *field = cell.data(FieldDataRole).value<const Field *>();
    if (!field) {
        m_shown.clear();
        m_name->setText(tr("No register selected"));
        m_facts->clear();
        QStringList lines{tr("Select a row to read what the register is for.")};
        for (const QString &note : m_notes)
            lines << warned(note, palette());
        m_text->setText(asParagraphs(lines));
        return;
    }
    const QString text = asParagraphs(linesFor(cell, *field));
    if (text == m_shown && m_name->text() == field->name)
        return;
    m_shown = text;
    m_name->setText(field->name);
    m_facts->setText(factsText(*field));
    m_text->setText(text);
}

/// What is said of a register, as HTML.
QStringList HelpPanel::linesFor(const QModelIndex &cell, const Field &field) const
{
    const auto effective = cell.data(EffectiveRole).value<EffectiveField>();
    const int resolution = cell.data(ResolutionRole).toInt();
    QStringList lines;
    if (const auto state = static_cast<RamState>(cell.data(RamStateRole).toInt()); state == RamState::Lost)
        lines << warned(ramStateText(state), palette());
    else if (state == RamState::Set)
        lines << ramStateText(state);
    if (!field.help.isEmpty())
        lines << field.help.toHtmlEscaped();
    if (!field.doubt.isEmpty())
        lines << warned(tr("Doubtful: %1").arg(field.doubt), palette());
    if (field.mayBeTried())
        lines << warned(tr("Whether it may be written isn't known: an edit asks before it is sent."), palette());
    QStringList facts;
    QString range = withUnits(field, effective, resolution, m_units, effective.minimum, effective.maximum);
    if (const QString source = rangeSource(effective); !range.isEmpty() && !source.isEmpty())
        range += QStringLiteral(", ") + source.toHtmlEscaped();
    if (!range.isEmpty() && field.isWritable() && field.values.empty())
        facts << tr("Range %1").arg(range);
    if (field.initial && field.isWritable())
        facts << tr("Default %1").arg(
            withUnits(field, effective, resolution, m_units, field.initial, field.initial).toHtmlEscaped());
    if (!facts.isEmpty())
        lines << facts.join(QStringLiteral(" &nbsp;·&nbsp; "));
    if (const QString meanings = meaningsText(field); !meanings.isEmpty())
        lines << meanings;
    if (!field.resets.isEmpty())
        lines << tr("A write here also resets %1.").arg(field.resets.join(QStringLiteral(", ")).toHtmlEscaped());
    if (const QString lock = cell.data(LockRole).toString(); isEditable(field) && !lock.isEmpty())
        lines << warned(lock, palette());
    return lines;
}

} // namespace dynascope
