// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/tabletools.h"

#include "ui/common/icons.h"
#include "ui/table/fieldfiltermodel.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLineEdit>
#include <QToolButton>

namespace dynascope {

TableTools::TableTools(FieldFilterModel &filter, QWidget *parent)
    : QWidget(parent)
    , m_filter(filter)
    , m_search(new QLineEdit(this))
{
    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(8, 8, 8, 8);
    layout->setSpacing(6);
    m_search->setObjectName(QStringLiteral("tableSearch"));
    m_search->setAccessibleName(tr("Search the registers"));
    m_search->setPlaceholderText(tr("Search name, address, help"));
    m_search->setToolTip(tr("Search the registers (Ctrl+F)"));
    m_search->setClearButtonEnabled(true);
    m_search->addAction(icon(QStringLiteral("search"), IconTint::Dimmed), QLineEdit::LeadingPosition);
    m_search->setMinimumWidth(140);
    m_search->installEventFilter(this);
    layout->addWidget(m_search, 1);
    connect(m_search, &QLineEdit::textChanged, this, [this](const QString &text) {
        m_filter.setSearch(text);
        emit filterChanged();
    });

    const auto connectFilter = [this](QToolButton *button, void (FieldFilterModel::*set)(bool)) {
        connect(button, &QToolButton::toggled, this, [this, set](bool on) {
            (m_filter.*set)(on);
            emit filterChanged();
        });
    };
    connectFilter(addToggle("filterChanged", tr("Changed"), tr("Only what differs from the factory's default")),
                  &FieldFilterModel::setOnlyChanged);
    connectFilter(addToggle("filterWritable", tr("Writable"), tr("Only what can be written")),
                  &FieldFilterModel::setOnlyWritable);
    connectFilter(addToggle("filterWatched", tr("Plotted"), tr("Only what is being plotted")),
                  &FieldFilterModel::setOnlyWatched);
    m_setHere = addToggle("filterSetHere", tr("Set here"),
                          tr("Only what was set in this session and is gone at power-off"));
    connectFilter(m_setHere, &FieldFilterModel::setOnlySetHere);
    m_setHere->hide();
    m_different = addToggle("filterDifferent", tr("Differing"),
                            tr("Only settings that differ between the devices: not what is measured, nor goals, ID and "
                               "Homing Offset"));
    connectFilter(m_different, &FieldFilterModel::setOnlyDifferent);
    setDeviceCount(0);
}

QToolButton *TableTools::addToggle(const char *objectName, const QString &text, const QString &toolTip)
{
    auto *button = new QToolButton(this);
    button->setObjectName(QString::fromLatin1(objectName));
    button->setText(text);
    button->setToolTip(toolTip);
    button->setCheckable(true);
    layout()->addWidget(button);
    return button;
}

void TableTools::setDeviceCount(int count)
{
    const bool several = count > 1;
    m_different->setVisible(several);
    if (!several)
        m_different->setChecked(false);
}

void TableTools::setAnySetHere(bool any)
{
    if (!any)
        m_setHere->setChecked(false);
    m_setHere->setVisible(any);
}

void TableTools::showSetHere()
{
    m_search->clear();
    for (auto *button : findChildren<QToolButton *>()) {
        if (button->isCheckable())
            button->setChecked(button == m_setHere && !m_setHere->isHidden());
    }
}

bool TableTools::eventFilter(QObject *watched, QEvent *event)
{
    if (watched == m_search && event->type() == QEvent::KeyPress) {
        const int key = static_cast<QKeyEvent *>(event)->key();
        if (key == Qt::Key_Escape)
            m_search->clear();
        if (key == Qt::Key_Escape || key == Qt::Key_Down || key == Qt::Key_Return || key == Qt::Key_Enter) {
            emit leaveSearch();
            return true;
        }
    }
    return QWidget::eventFilter(watched, event);
}

} // namespace dynascope
