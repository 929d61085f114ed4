// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/controltable.h"

#include <QHash>

namespace dynascope {

/// Which models have which registers: what a search over the whole library asks. Tables are added in whatever steps
/// their owner takes. A value, for one thread.
class RegisterIndex
{
public:
    struct Owner {
        std::uint16_t modelNumber = 0;
        int firmwareFrom = 0, firmwareTo = 255; ///< 0 to 255: whatever firmware it has

        friend bool operator==(const Owner &, const Owner &) = default;
    };
    /// A register of this name and size at this address.
    struct Entry {
        QString name;
        std::uint16_t address = 0;
        std::uint8_t size = 1;
        std::vector<Owner> owners; ///< in the order in which they were added
    };

    /// Tables of one model follow one another, the oldest firmware first.
    void add(const ControlTable &table);
    bool isEmpty() const { return m_entries.empty(); }

    /// A number (102, 0x66): what begins at that address, then what it lies in. Else the registers in whose names all
    /// the words are, best first; a word that is a number may also be the address. They live until the next add().
    std::vector<const Entry *> find(const QString &text) const;

private:
    struct Kept : Entry {
        QString plain; ///< name, normalized
        QString stem;  ///< the same without the number it ends in, so that 2 comes before 10
        int number = -1;
        QStringList words; ///< of the name, normalized
    };

    std::vector<const Entry *> atAddress(int address) const;
    static int rank(const Kept &entry, const QString &wanted, const QStringList &words);

    std::vector<Kept> m_entries;
    QHash<QString, QList<std::size_t>> m_byName; ///< indices of entries with this very name
};

} // namespace dynascope
