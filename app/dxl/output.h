// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/document.h"
#include "app/dxl/options.h"

#include <QByteArrayList>

namespace dynascope::dxl {

/// Results go to standard output, text at once, JSON as one document at the end; everything else goes to standard error,
/// a sentence each.
class Output
{
public:
    explicit Output(bool json) : m_json(json) {}

    /// One result, said both ways.
    void result(const QString &text, const Document &document);
    /// JSON will be an array, also of one or none. Otherwise it is the one result.
    void expectMany() { m_many = true; }

    /// In a JSON array, in place of the result that did not come.
    void failedResult(const Document &document);

    /// A write of which nothing can be read back: a place in the JSON, a note else.
    void unconfirmed(const QString &text, const Document &document);

    ExitCode fail(const Error &error);   ///< a device or the line failed
    ExitCode refuse(const Error &error); ///< what was asked makes no sense
    void note(const QString &text); ///< not an error; without the final stop

    void finish();

private:
    bool m_json;
    bool m_many = false;
    QByteArrayList m_documents;
};

} // namespace dynascope::dxl
