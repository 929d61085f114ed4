// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/common/messagebar.h"
#include "ui/plot/csvsave.h"

#include <QPixmap>

namespace dynascope {

/// Asks where plots shall be saved, has them saved, and says what became of it.
class PlotSaver : public QObject
{
    Q_OBJECT

public:
    PlotSaver(const Monitor &monitor, QWidget *window);

    /// `traces` is asked once the name is chosen. Refused while another is being written.
    void askForCsv(std::function<std::vector<CsvSave::Trace>()> traces, LineTime from, LineTime end);
    void askForPicture(const QPixmap &picture);
    void askForDrawing(const QByteArray &svg);

signals:
    void posted(const dynascope::Message &message);

private:
    void ask(const QString &title, const QString &suffix, std::function<void(const QString &)> save);
    void sayWritten(const QString &path);
    void sayFailed(const Error &error);
    void sayItLasts();

    QWidget *m_window;
    CsvSave m_csv;
    QTimer m_patience; ///< what is done at once needs no word before
};

} // namespace dynascope
