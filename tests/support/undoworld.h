// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/journal/undo.h"
#include "tests/support/sessionfixture.h"

namespace dynascope::test {

constexpr int UndoRate = 57600;

struct UndoWorld {
    explicit UndoWorld(const Catalog &catalog,
                       const QString &servos = QStringLiteral("XM430-W350@57600:1,XL430-W250@57600:2"))
        : all(catalog, servos, &journal), undo(all.session, all.commands)
    {
    }

    void open(int baudRate = UndoRate)
    {
        all.open(baudRate);
        for (const auto &device : all.line->devices())
            (void)run([&](const auto &done) { all.commands.readAll(*device, done); });
    }
    Device &device(int id, int baudRate = UndoRate)
    {
        Device *found = all.line->deviceAt(static_cast<std::uint8_t>(id), baudRate);
        if (!found)
            qFatal("no device %d at %d", id, baudRate);
        return *found;
    }
    Result<void> run(const std::function<void(const Commands::Done &)> &order)
    {
        std::optional<Result<void>> result;
        order([&](const Result<void> &outcome) { result = outcome; });
        if (!VirtualSession::waitFor([&] { return result.has_value(); }))
            return failure(ErrorKind::NothingReceived, QStringLiteral("hung"));
        return *result;
    }
    Result<void> write(int id, QStringView field, std::int64_t raw)
    {
        return run([&](const auto &done) {
            all.commands.writeField(device(id), device(id).table().indexOf(field), raw, done);
        });
    }
    Result<void> torque(int id, bool on)
    {
        return run([&](const auto &done) { all.commands.setTorque({&device(id)}, on, done); });
    }
    /// Empty: done.
    QString revert(std::vector<qint64> numbers, Direction direction = Direction::Undo, const UndoOptions &options = {})
    {
        const auto result = run([&](const auto &done) { undo.run(numbers, direction, options, done); });
        return result ? QString() : result.error().text;
    }
    /// What a servo really holds; the line is closed for it and opened again.
    std::int64_t value(int id, QStringView field, int baudRate = UndoRate)
    {
        all.close();
        sim::Servo *servo = all.factory.simulated.servo(id, baudRate);
        const std::int64_t raw = servo ? servo->value(field) : -1;
        all.open(baudRate);
        return raw;
    }
    qint64 last() const { return journal.entries().back().number; }

    /// An entry as a program might have noted it, or a hand.
    qint64 note(int id, std::vector<RegisterChange> changes, int baudRate = UndoRate)
    {
        const Device &on = device(id, baudRate);
        JournalEntry entry;
        entry.device = {on.line()->name(), {}, on.table().model(), on.table().modelNumber(), on.firmware(), id,
                        baudRate};
        entry.changes = std::move(changes);
        const qint64 number = journal.begin(entry);
        entry.state = JournalState::Done;
        journal.finish(number, entry);
        return number;
    }

    Journal journal;
    VirtualSession all;
    Undo undo;
};

} // namespace dynascope::test
