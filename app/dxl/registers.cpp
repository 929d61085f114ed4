// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/registers.h"

namespace dynascope::dxl {

namespace {

constexpr int LongestStretch = 128; ///< bytes; a damaged answer costs no more than that

/// Neighbours without a gap: what is not in the table may be refused.
std::vector<std::vector<const Field *>> stretches(const ControlTable &table,
                                                  const std::function<bool(const Field &)> &wanted)
{
    std::vector<std::vector<const Field *>> all;
    for (const Field &field : table.fields()) {
        if (!wanted(field))
            continue;
        const bool follows = !all.empty() && all.back().back()->end() == field.address
                             && field.end() - all.back().front()->address <= LongestStretch;
        if (!follows)
            all.emplace_back();
        all.back().push_back(&field);
    }
    return all;
}

Result<void> readOneByOne(Device &device, const std::vector<const Field *> &fields, std::vector<Reading> &readings)
{
    for (const Field *field : fields) {
        auto raw = device.read(*field);
        if (!raw && raw.error().kind != ErrorKind::Refused)
            return tl::unexpected(raw.error());
        readings.push_back(raw ? Reading{field, *raw, {}} : Reading{field, {}, raw.error().text});
    }
    return {};
}

} // namespace

Result<std::vector<Reading>> readFields(Device &device, const std::function<bool(const Field &)> &wanted,
                                        const std::function<void(double)> &progress)
{
    std::vector<Reading> readings;
    const auto all = stretches(*device.table(), wanted);
    for (std::size_t i = 0; i < all.size(); ++i) {
        progress(static_cast<double>(i) / static_cast<double>(all.size()));
        const std::vector<const Field *> &fields = all[i];
        const int begin = fields.front()->address;
        const auto bytes = device.read(begin, fields.back()->end() - begin);
        if (!bytes && bytes.error().kind == ErrorKind::Refused) {
            if (const auto read = readOneByOne(device, fields, readings); !read)
                return tl::unexpected(read.error());
            continue;
        }
        if (!bytes)
            return tl::unexpected(bytes.error());
        for (const Field *field : fields) {
            const ByteView part =
                ByteView(*bytes).subspan(static_cast<std::size_t>(field->address - begin), field->size);
            readings.push_back({field, rawFromBytes(*field, part), {}});
            device.learn(*field, *readings.back().raw);
        }
    }
    return readings;
}

} // namespace dynascope::dxl
