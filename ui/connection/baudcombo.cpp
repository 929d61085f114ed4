// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/connection/baudcombo.h"

#include "core/session/scanner.h"
#include "ui/common/texts.h"

#include <QLineEdit>
#include <QRegularExpression>

namespace dynascope {

BaudCombo::BaudCombo(QWidget *parent)
    : QComboBox(parent)
{
    setObjectName(QStringLiteral("baudCombo"));
    setEditable(true);
    setInsertPolicy(QComboBox::NoInsert);
    setMinimumContentsLength(10);
    setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    setToolTip(tr("Baud rate the line works at; a scan finds devices at other rates too"));
    setAccessibleName(tr("Baud rate"));
    for (const int baud : allBauds())
        addItem(baudText(baud), baud);
    setBaudRate(57600);
    connect(this, &QComboBox::activated, this, [this] { emit baudRateChosen(baudRate()); });
    connect(lineEdit(), &QLineEdit::returnPressed, this, [this] {
        if (const int baud = baudRate())
            emit baudRateChosen(baud);
    });
}

int BaudCombo::parse(const QString &text)
{
    static const QRegularExpression pattern(QStringLiteral(R"(^([0-9]+(?:\.[0-9]+)?)([kM]?)(?:bps|bit/s|baud)?$)"),
                                            QRegularExpression::CaseInsensitiveOption);
    QString plain = text;
    static const QRegularExpression space(QStringLiteral(R"([\s\x{2009}_']+)"));
    plain.remove(space);
    const auto match = pattern.match(plain);
    if (!match.hasMatch())
        return 0;
    double number = match.captured(1).toDouble();
    const QString unit = match.captured(2).toLower();
    if (unit == QStringLiteral("m"))
        number *= 1e6;
    else if (unit == QStringLiteral("k"))
        number *= 1e3;
    return number >= 1200 && number <= 12e6 ? qRound(number) : 0;
}

int BaudCombo::baudRate() const
{
    return parse(currentText());
}

void BaudCombo::setBaudRate(int bitsPerSecond)
{
    const int index = findData(bitsPerSecond);
    if (index >= 0)
        setCurrentIndex(index);
    setEditText(baudText(bitsPerSecond));
}

} // namespace dynascope
