// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/output.h"

#include <cstdio>

namespace dynascope::dxl {

void Output::result(const QString &text, const Document &document)
{
    if (m_json) {
        m_documents.append(document.toJson());
        return;
    }
    std::printf("%s\n", qUtf8Printable(text));
    std::fflush(stdout); // a scan is followed as it goes, also through a pipe
}

void Output::failedResult(const Document &document)
{
    if (m_json && m_many)
        m_documents.append(document.toJson());
}

void Output::unconfirmed(const QString &text, const Document &document)
{
    note(text);
    if (m_json)
        m_documents.append(document.toJson());
}

ExitCode Output::fail(const Error &error)
{
    note(error.text);
    return ExitCode::Failed;
}

ExitCode Output::refuse(const Error &error)
{
    note(error.text);
    return ExitCode::Usage;
}

void Output::note(const QString &text)
{
    std::fprintf(stderr, "dxl: %s\n", qUtf8Printable(text));
}

void Output::finish()
{
    if (!m_json)
        return;
    if (m_many)
        std::printf("[%s]\n", m_documents.join(",\n ").constData());
    else if (!m_documents.isEmpty())
        std::printf("%s\n", m_documents.constFirst().constData());
    std::fflush(stdout);
}

} // namespace dynascope::dxl
