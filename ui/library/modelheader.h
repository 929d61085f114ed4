// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/catalog.h"

#include <QWidget>

class QComboBox;
class QLabel;

namespace dynascope {

/// What is known of a model as a whole, and which of its firmware the registers below are of.
class ModelHeader : public QWidget
{
    Q_OBJECT

public:
    explicit ModelHeader(QString folder, QWidget *parent = nullptr); ///< `folder`: of a person's own tables

    /// `all`: its tables, the oldest firmware first; `shown` is one of them.
    void setModel(const Catalog::ModelInfo &info, const std::vector<ControlTablePtr> &all, std::size_t shown);
    void setRefused(const QString &file, const QString &message);
    void setTitle(const QString &title, const QString &text); ///< without a model

signals:
    void tableChosen(int table); ///< by a person; index among all

protected:
    void changeEvent(QEvent *event) override;

private:
    void refresh(); ///< rich text carries its colours with it

    QString m_folder;
    Catalog::ModelInfo m_info;
    std::vector<ControlTablePtr> m_all;
    QLabel *m_name;
    QLabel *m_about;
    QLabel *m_facts;
    QComboBox *m_firmware;
};

} // namespace dynascope
