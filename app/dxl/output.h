// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/document.h"
#include "app/dxl/options.h"

#include <QByteArrayList>

namespace dynascope::dxl {

/// Results go to standard output, text at once, JSON as one document at the end; everything else goes to standard
/// error, a sentence each.
class Output
{
public:
    explicit Output(bool json) : m_json(json) { }

    /// One result, said both ways.
    void result(const QString &text, const Document &document);
    /// The same, of a device: named in front of the text where there are several.
    void result(std::uint8_t id, const QString &text, const Document &document);
    QString named(std::uint8_t id, const QString &text) const; ///< the device in front of it where there are several
    /// JSON will be an array, also of one or none. Otherwise it is the one result.
    void expectMany() { m_many = true; }
    /// There are several devices; JSON will be an array.
    void expectDevices() { m_many = m_nameDevices = true; }
    /// JSON will be one object a line.
    void expectLines() { m_lines = true; }

    /// A line of its own, now: a sample, in whatever form the person asked for.
    void line(const QByteArray &text);
    /// Nobody reads standard output any more, or its disk is full: what is only for reading may end.
    bool isClosed() const { return m_closed; }
    /// It can't be written for another reason than that nobody reads it; that has been said.
    bool hasFailed() const { return m_failed; }

    /// In a JSON array, in place of the result that did not come.
    void failedResult(const Document &document);

    /// A write of which nothing can be read back: a place in the JSON, a note else.
    void unconfirmed(const QString &text, const Document &document);

    ExitCode fail(const Error &error);   ///< a device or the line failed
    ExitCode refuse(const Error &error); ///< what was asked makes no sense
    void note(const QString &text);      ///< not an error; without the final stop

    /// How far long work is, 0 to 1, where a person watches standard error; gone with the next word.
    void progress(double done, const QString &text);

    void finish();

private:
    void print(const QByteArray &text);
    void wipe();

    bool m_json;
    bool m_many = false;
    bool m_nameDevices = false;
    bool m_lines = false;
    bool m_closed = false;
    bool m_failed = false;
    bool m_barShown = false;
    QByteArrayList m_documents;
};

/// Columns as wide as their widest cell; the columns named stand at the left, the others at the right.
QString aligned(const std::vector<QStringList> &rows, const std::vector<std::size_t> &leftColumns);

} // namespace dynascope::dxl
