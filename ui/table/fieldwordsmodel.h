// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/units.h"
#include "ui/table/tableroles.h"

#include <QIdentityProxyModel>

namespace dynascope {

/// Says FieldTableModel's raw values in words: text, tool tips, headers. Also as number and unit apart, for who paints
/// them.
class FieldWordsModel : public QIdentityProxyModel
{
    Q_OBJECT

public:
    explicit FieldWordsModel(QObject *parent = nullptr);

    void setAngleUnit(AngleUnit unit);
    AngleUnit angleUnit() const { return m_angle; }

    QVariant data(const QModelIndex &index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    struct Words {
        QString text;   ///< all of it
        QString number; ///< where it has a unit or is bare
        QString unit;
    };

    QVariant valueData(const QModelIndex &index, const Field &field, ColumnKind kind, int role) const;
    Words words(const QModelIndex &index, const Field &field, ColumnKind kind, std::int64_t raw) const;
    QString toolTip(const QModelIndex &index, const Field &field, ColumnKind kind) const;

    AngleUnit m_angle = AngleUnit::Degrees;
};

/// "0 … 4095"; empty where anything goes that fits.
QString rangeText(const EffectiveField &effective);

} // namespace dynascope
