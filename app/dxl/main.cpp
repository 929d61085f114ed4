// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/dxl.h"

#include <QCoreApplication>

int main(int argc, char **argv)
{
    const QCoreApplication application(argc, argv);
    return dynascope::dxl::run(argc, argv);
}
