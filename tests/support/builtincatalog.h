// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/catalog.h"

namespace dynascope::test {

/// The tables that come with the program; without them no test can go on.
inline Catalog builtInCatalog()
{
    Result<Catalog> loaded = Catalog::builtIn();
    if (!loaded)
        qFatal("%s", qPrintable(loaded.error().text));
    return std::move(*loaded);
}

} // namespace dynascope::test
