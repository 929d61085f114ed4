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

    void setUnits(const UnitPreferences &units);

    QVariant data(const QModelIndex &index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    struct Words {
        QString text;   ///< all of it
        QString number; ///< where it has a unit or is bare
        QString unit;
    };

    using LimitText = QString (*)(const Field &, const EffectiveField &, int, const UnitPreferences &);

    QVariant valueData(const QModelIndex &index, const Field &field, ColumnKind kind, int role) const;
    Words words(const QModelIndex &index, const Field &field, ColumnKind kind, std::int64_t raw) const;
    QString indirectText(const QModelIndex &index, const Field &field, std::int64_t raw) const;
    QString limit(const QModelIndex &index, const Field &field, LimitText text) const;
    bool hasMeaning(const QModelIndex &index, const Field &field) const;
    QString toolTip(const QModelIndex &index, const Field &field, ColumnKind kind) const;

    UnitPreferences m_units;
};

/// That it was set in this session and goes with the power, or has gone, a sentence; empty where it wasn't.
QString ramStateText(RamState state);

} // namespace dynascope
