// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/modelheader.h"

#include "ui/common/theme.h"
#include "ui/library/firmwarechanges.h"
#include "ui/library/librarytexts.h"

#include <QComboBox>
#include <QEvent>
#include <QLabel>
#include <QVBoxLayout>

namespace dynascope {

ModelHeader::ModelHeader(QString folder, QWidget *parent)
    : QWidget(parent)
    , m_folder(std::move(folder))
    , m_name(new QLabel(this))
    , m_about(new QLabel(this))
    , m_facts(new QLabel(this))
    , m_firmware(new QComboBox(this))
{
    QFont large = font();
    large.setPointSizeF(large.pointSizeF() * 1.25);
    large.setWeight(QFont::DemiBold);
    m_name->setFont(large);
    m_name->setObjectName(QStringLiteral("libraryModel"));
    m_name->setTextFormat(Qt::PlainText);
    m_about->setObjectName(QStringLiteral("libraryAbout"));
    m_facts->setObjectName(QStringLiteral("libraryFacts"));
    m_facts->setWordWrap(true);
    m_facts->setOpenExternalLinks(true); // an https address, or the table would have been refused
    m_facts->setTextInteractionFlags(Qt::LinksAccessibleByMouse | Qt::LinksAccessibleByKeyboard);
    m_about->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    for (QLabel *label : {m_about, m_facts})
        label->setTextFormat(Qt::RichText);
    m_firmware->setObjectName(QStringLiteral("libraryFirmware"));
    m_firmware->setAccessibleName(tr("Firmware"));
    m_firmware->setToolTip(tr("The control table of this model depends on its firmware: choose which is shown"));
    connect(m_firmware, &QComboBox::activated, this, &ModelHeader::tableChosen);

    auto *first = new QHBoxLayout;
    first->setSpacing(12);
    first->addWidget(m_name);
    first->addWidget(m_about, 1);
    first->addWidget(m_firmware);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(12, 8, 8, 4);
    layout->setSpacing(4);
    layout->addLayout(first);
    layout->addWidget(m_facts);
    setTitle({}, {});
}

void ModelHeader::setModel(const Catalog::ModelInfo &info, const std::vector<ControlTablePtr> &all, std::size_t shown)
{
    m_info = info;
    m_all = all;
    m_name->setText(info.model);
    m_firmware->clear();
    for (const ControlTablePtr &table : all) {
        QString text = firmwareText(table->description().firmwareFrom, table->description().firmwareTo);
        text[0] = text[0].toUpper();
        m_firmware->addItem(text);
    }
    m_firmware->setVisible(all.size() > 1);
    m_firmware->setCurrentIndex(static_cast<int>(shown));
    refresh();
}

void ModelHeader::refresh()
{
    if (m_all.empty())
        return;
    const ControlTable &table = *m_all[static_cast<std::size_t>(std::max(0, m_firmware->currentIndex()))];
    QString about =
        tr("model number %1 &nbsp;·&nbsp; series %2").arg(m_info.modelNumber).arg(m_info.series.toHtmlEscaped());
    if (m_info.newestFirmware >= 0)
        about += tr(" &nbsp;·&nbsp; known up to firmware %1").arg(m_info.newestFirmware);
    m_about->setText(about);
    QString facts = modelFacts(m_info, table, m_folder, palette());
    if (const QStringList missing = onlyInOtherFirmware(table, m_all); !missing.isEmpty()) {
        facts += QStringLiteral("<br><span style=\"color:%1\">%2</span>")
                     .arg(colors(palette()).accent.name(),
                          tr("Not in this firmware: %1").arg(missing.join(QStringLiteral("; "))).toHtmlEscaped());
    }
    m_facts->setText(facts);
    m_facts->show();
}

void ModelHeader::setRefused(const QString &file, const QString &message)
{
    setTitle(file,
             tr("This file of your own was not read. Mend it and start again; <b>dxl models check</b> tells the same "
                "at once.<br><br>%1")
                 .arg(message.toHtmlEscaped()));
}

void ModelHeader::setTitle(const QString &title, const QString &text)
{
    m_all.clear();
    m_name->setText(title);
    m_about->clear();
    m_facts->setText(text);
    m_facts->setVisible(!text.isEmpty());
    m_firmware->hide();
}

void ModelHeader::changeEvent(QEvent *event)
{
    if (event->type() == QEvent::PaletteChange)
        refresh();
    QWidget::changeEvent(event);
}

} // namespace dynascope
