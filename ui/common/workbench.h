// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace dynascope {

class Session;
class Commands;
class Monitor;
class Scanner;
class StopControl;
class PortList;

/// What the window's parts work on. Made by app, which owns all of it and outlives the window.
struct Workbench {
    Session &session;
    Commands &commands;
    Monitor &monitor;
    Scanner &scanner;
    StopControl &stop;
    PortList &ports;
};

} // namespace dynascope
