// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <memory>

namespace dynascope {

/// A value that is made when somebody first asks for it and never changes from then on. Any thread may ask: two that
/// ask at once may both make it, which must come to the same, and one of the two is kept.
template <typename T>
class Memo
{
public:
    Memo() = default;
    ~Memo() { const std::unique_ptr<const T> owned(m_value.load(std::memory_order_acquire)); }
    Memo(const Memo &) = delete;
    Memo &operator=(const Memo &) = delete;

    template <typename Make>
    const T &get(Make make) const
    {
        if (const T *there = m_value.load(std::memory_order_acquire))
            return *there;
        auto made = std::make_unique<const T>(make());
        const T *first = nullptr;
        if (m_value.compare_exchange_strong(first, made.get(), std::memory_order_acq_rel, std::memory_order_acquire))
            return *made.release(); // the destructor has it now
        return *first;
    }

private:
    mutable std::atomic<const T *> m_value{nullptr};
};

} // namespace dynascope
