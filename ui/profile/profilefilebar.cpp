// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/profile/profilefilebar.h"

#include "ui/common/elidedlabel.h"
#include "ui/common/filedialogs.h"
#include "ui/common/icons.h"
#include "ui/common/texts.h"
#include "ui/common/theme.h"

#include <QAction>
#include <QDir>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QSettings>
#include <QVBoxLayout>

namespace dynascope {
namespace {

const QString RecentKey = QStringLiteral("profile/recent");
constexpr qsizetype MostRecent = 8;
constexpr int EmptyWidth = 480;

} // namespace

ProfileFileBar::ProfileFileBar(QWidget *parent)
    : QWidget(parent)
    , m_robot(new QLabel(this))
    , m_path(new ElidedLabel(this))
    , m_recentMenu(new QMenu(this))
    , m_saveMenu(new QMenu(this))
    , m_open(addButton("openProfileButton", tr("&Open…"), nullptr))
    , m_recent(addButton("recentProfilesButton", tr("&Recent"), m_recentMenu))
    , m_save(addButton("saveProfileButton", tr("&Save"), m_saveMenu))
    , m_saveNew(m_saveMenu->addAction(tr("As a &new file, from the bus…")))
    , m_saveInto(m_saveMenu->addAction(tr("&Into this file, what differs")))
{
    m_saveMenu->addSeparator();
    m_calibration = m_saveMenu->addAction(tr("With &calibration (Homing Offset)"));
    m_calibration->setCheckable(true);
    m_calibration->setObjectName(QStringLiteral("calibrationAction"));
    m_calibration->setToolTip(tr("It belongs to one single servo: a spare part has another"));
    m_saveNew->setObjectName(QStringLiteral("saveNewAction"));
    m_saveInto->setObjectName(QStringLiteral("saveIntoAction"));
    m_saveInto->setToolTip(tr("Comments and order stay; only values are changed, and what is missing is added"));
    m_saveMenu->setToolTipsVisible(true);
    m_robot->setFont(boldened(m_robot->font()));
    m_robot->setTextFormat(Qt::PlainText);
    m_robot->setObjectName(QStringLiteral("robotName"));
    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(8);
    layout->addWidget(m_robot);
    layout->addWidget(m_path, 1);
    for (QPushButton *button : {m_open, m_recent, m_save})
        layout->addWidget(button);
    connect(m_open, &QPushButton::clicked, this, &ProfileFileBar::askWhat);
    connect(m_saveNew, &QAction::triggered, this, &ProfileFileBar::askWhere);
    connect(m_saveInto, &QAction::triggered, this, &ProfileFileBar::saveIntoRequested);
    connect(m_recentMenu, &QMenu::aboutToShow, this, &ProfileFileBar::fillRecent);
}

QWidget *ProfileFileBar::makeEmptyPage(QWidget *parent)
{
    auto *page = new QWidget(parent);
    auto *text = new QLabel(tr("A profile is one file for a robot: its joints by name, their model, ID and baud rate, "
                               "and the values that their registers shall have."),
                            page);
    text->setAlignment(Qt::AlignCenter);
    text->setWordWrap(true);
    text->setFixedWidth(EmptyWidth);
    text->setMinimumHeight(text->heightForWidth(EmptyWidth)); // which no layout asks of one in its middle
    m_openFirst = new QPushButton(tr("Open a file…"), page);
    m_openFirst->setObjectName(QStringLiteral("openFirstButton"));
    m_saveFirst = new QPushButton(tr("Save what is on the bus as a new file…"), page);
    m_saveFirst->setObjectName(QStringLiteral("saveFirstButton"));
    for (QPushButton *button : {m_openFirst, m_saveFirst})
        button->setAutoDefault(false);
    auto *buttons = new QHBoxLayout;
    buttons->setSpacing(8);
    buttons->addStretch(1);
    buttons->addWidget(m_openFirst);
    buttons->addWidget(m_saveFirst);
    buttons->addStretch(1);
    auto *layout = new QVBoxLayout(page);
    layout->setSpacing(16);
    layout->addStretch(1);
    layout->addWidget(text, 0, Qt::AlignHCenter);
    layout->addLayout(buttons);
    layout->addStretch(1);
    connect(m_openFirst, &QPushButton::clicked, this, &ProfileFileBar::askWhat);
    connect(m_saveFirst, &QPushButton::clicked, this, &ProfileFileBar::askWhere);
    return page;
}

/// Its menu pops up: one that is executed would be an event loop of its own.
QPushButton *ProfileFileBar::addButton(const char *name, const QString &text, QMenu *menu)
{
    auto *button = new QPushButton(text, this);
    button->setObjectName(QLatin1String(name));
    button->setAutoDefault(false);
    if (!menu)
        return button;
    menu->setObjectName(QLatin1String(name) + QStringLiteral("Menu"));
    button->setIcon(icon(QStringLiteral("chevron-down")));
    button->setLayoutDirection(Qt::RightToLeft);
    connect(button, &QPushButton::clicked, this,
            [button, menu] { menu->popup(button->mapToGlobal(QPoint(0, button->height() + 4))); });
    return button;
}

void ProfileFileBar::setFile(const QString &robot, const QString &path)
{
    m_robot->setText(path.isEmpty() ? tr("No file") : robot);
    m_robot->setVisible(!m_robot->text().isEmpty());
    m_path->setText(QDir::toNativeSeparators(path));
}

void ProfileFileBar::setUse(bool mayOpen, bool maySave, bool hasFile)
{
    m_open->setEnabled(mayOpen);
    m_recent->setEnabled(mayOpen);
    m_save->setEnabled(maySave);
    m_saveInto->setEnabled(hasFile);
    if (!m_openFirst)
        return;
    m_openFirst->setEnabled(mayOpen);
    m_saveFirst->setEnabled(maySave);
    m_saveFirst->setToolTip(maySave ? QString() : tr("No line is open"));
}

bool ProfileFileBar::includesCalibration() const
{
    return m_calibration->isChecked();
}

void ProfileFileBar::askWhat()
{
    askWhatToOpen(this, tr("Open a robot's profile"), {QStringLiteral("yaml"), QStringLiteral("yml")},
                  [this](const QString &path) { emit openRequested(path); });
}

void ProfileFileBar::askWhere()
{
    askWhereToSave(this, tr("Save what is on the bus as a robot's profile"), QStringLiteral("yaml"),
                   QStringLiteral("robot.yaml"), [this](const QString &path) { emit saveNewRequested(path); });
}

void ProfileFileBar::fillRecent()
{
    m_recentMenu->clear();
    for (const QString &path : recent()) {
        QAction *action = m_recentMenu->addAction(plainLabel(QDir::toNativeSeparators(path)));
        connect(action, &QAction::triggered, this, [this, path] { emit openRequested(path); });
    }
    if (m_recentMenu->isEmpty())
        m_recentMenu->addAction(tr("None yet"))->setEnabled(false);
}

QStringList ProfileFileBar::recent()
{
    return QSettings().value(RecentKey).toStringList().mid(0, MostRecent);
}

void ProfileFileBar::remember(const QString &path)
{
    QStringList paths = recent();
    paths.removeAll(path);
    paths.prepend(path);
    QSettings().setValue(RecentKey, paths.mid(0, MostRecent));
}

} // namespace dynascope
