// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace dynascope {

class Session;
class Commands;
class Monitor;
class Scanner;
class StopControl;
class PortList;
class Journal;
class Undo;
class SettingsCommands;
class RamGuard;
class IndirectReads;

/// What the window's parts work on. Made by app, which owns all of it and outlives the window.
struct Workbench {
    Session &session;
    Commands &commands;
    Monitor &monitor;
    Scanner &scanner;
    StopControl &stop;
    PortList &ports;
    Journal *journal = nullptr; ///< with `undo`, or neither
    Undo *undo = nullptr;
    SettingsCommands *settings = nullptr; ///< without it nothing is told before a write
    RamGuard *ramGuard = nullptr; ///< only with `journal`
    IndirectReads *indirect = nullptr; ///< without it nothing is packed
};

} // namespace dynascope
