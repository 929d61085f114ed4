// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/common/messagebar.h"
#include "ui/plot/csvsave.h"

namespace dynascope {

class PlotPanel;

/// Asks where what the panels show shall be saved, has it saved, and says what became of it. Pictures and times are of when
/// it was asked: a live plot moves on while the person chooses a name. Which traces there are is looked at then.
class PlotSaver : public QObject
{
    Q_OBJECT

public:
    /// Dialogs belong to `window`. All outlive this.
    PlotSaver(const Monitor &monitor, const std::vector<PlotPanel *> &panels, QWidget &window);

    void saveCsv(const PlotPanel &timed); ///< all samples in its view, of all panels. Refused while another is written
    void savePicture();
    void saveDrawing();

signals:
    void posted(const dynascope::Message &message);

private:
    std::vector<CsvSave::Trace> traces() const;
    void ask(const QString &title, const QString &suffix, std::function<void(const QString &)> save);
    void sayWritten(const QString &path);
    void sayFailed(const Error &error);
    void sayItLasts();

    const std::vector<PlotPanel *> &m_panels;
    QWidget &m_window;
    CsvSave m_csv;
    QTimer m_patience; ///< what is done at once needs no word before
};

} // namespace dynascope
