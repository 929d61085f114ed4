// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/window/options.h"
#include "app/window/pictures.h"
#include "app/window/workshop.h"

#include <QApplication>

int main(int argc, char **argv)
{
    QApplication application(argc, argv);
    dynascope::setUpApplication(application);
    const dynascope::WindowOptions options = dynascope::parseOptions(application);
    const dynascope::OwnSettings settings(options); // before anything reads them
    dynascope::Workshop workshop(application, options);
    return dynascope::runWindow(application, workshop, options);
}
