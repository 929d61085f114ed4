// SPDX-License-Identifier: GPL-3.0-or-later
// Any text as a ".model" file or a CSV: it is refused with a sentence, or what is made of it is a table of our own.
// A byte: what the caller adds to it; then the text.
#include "core/table/catalog.h"
#include "core/table/tableimport.h"
#include "tests/fuzz/fuzzinput.h"

using namespace dynascope;
using fuzz::must;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    if (size == 0)
        return 0;
    ImportOptions options;
    if ((data[0] & 1) != 0)
        options.number = 1999;
    if ((data[0] & 2) != 0)
        options.name = QStringLiteral("Mine");
    const QByteArray text(reinterpret_cast<const char *>(data) + 1, static_cast<qsizetype>(size - 1));
    const Result<ImportedTable> table = importTable(text, QStringLiteral("fuzz.txt"), options);
    if (!table) {
        must(table.error().text.startsWith(u"fuzz.txt: "), "a refusal names the file");
        return 0;
    }
    Catalog catalog;
    must(catalog.add(table->json, QStringLiteral("made.json")).has_value(), "what was made is sound");
    must(catalog.models().size() == 1, "it is one model");
    const ControlTablePtr made = catalog.find(catalog.models().front().modelNumber, 0);
    must(made && !made->fields().empty(), "it has registers");
    return 0;
}
