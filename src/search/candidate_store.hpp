// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Memory of candidate lists, and the one sort by label that makes all rows of a block come out
/// sorted.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#include "kernels.hpp"

namespace connectivity::detail {

/// Grow-only memory, not initialised, from the start of a cache line: wide loads that straddle
/// lines take twice as long.
template <class T>
class Buffer {
    static_assert(std::is_trivial_v<T>);

public:
    T* data() { return data_.get(); }
    const T* data() const { return data_.get(); }

    /// Room for n elements; of those there are, the first `keep` survive growth.
    void reserve(std::size_t n, std::size_t keep = 0) {
        if (n <= capacity_) return;
        const std::size_t grown = std::max(n, capacity_ + capacity_ / 2);
        Memory fresh(static_cast<T*>(::operator new(grown * sizeof(T), line)));
        std::copy_n(data_.get(), std::min(keep, capacity_), fresh.get());
        data_ = std::move(fresh);
        capacity_ = grown;
    }
    std::size_t bytes() const { return capacity_ * sizeof(T); }

private:
    static constexpr std::align_val_t line{64};
    struct Free {
        void operator()(T* data) const { ::operator delete(data, line); }
    };
    using Memory = std::unique_ptr<T, Free>;

    Memory data_;
    std::size_t capacity_ = 0;
};

template <int Dim>
class CandidateStore {
public:
    CandidateList<Dim> list{};

    /// Room for n candidates and what kernels write beyond; those in the list survive.
    void reserve(int n, Form form) {
        for (int d = 0; d < Dim; ++d) list.x[d] = room(x_[d], d, n);
        list.t = room(t_, Dim, n);
        list.label = room(label_, Dim + 1, n);
        if (form != Form::ellipsoids) return;
        for (int d = 0; d < Dim; ++d) list.width[d] = room(width_[d], Dim + 2 + d, n);
        for (int k = 0; k < metric_size<Dim>; ++k)
            list.metric[k] = room(metric_[k], 2 * Dim + 2 + k, n);
    }
    std::size_t bytes() const {
        std::size_t sum = t_.bytes() + label_.bytes();
        for (int d = 0; d < Dim; ++d) sum += x_[d].bytes() + width_[d].bytes();
        for (const auto& entry : metric_) sum += entry.bytes();
        return sum;
    }

private:
    /// Fields lie apart modulo a page: side by side they would share the sets of the cache.
    template <class T>
    T* room(Buffer<T>& buffer, int field, int n) {
        const auto shift = static_cast<std::size_t>(5 * 64 / sizeof(T) * field);
        buffer.reserve(shift + static_cast<std::size_t>(n) + list_slack,
                       shift + static_cast<std::size_t>(list.n));
        return buffer.data() + shift;
    }

    Buffer<float> x_[Dim], t_, width_[Dim], metric_[metric_size<Dim>];
    Buffer<int> label_;
};

/// Radix sort by label: the permutation first, then every field is moved once, one by one.
class LabelSort {
public:
    /// Sorts `in` into `out` (room reserved), labels < 2^label_bits, and pads `out`.
    template <int Dim>
    void operator()(const CandidateList<Dim>& in, int label_bits, Form form,
                    CandidateList<Dim>& out);

private:
    static constexpr int digit_bits = 11;
    Buffer<int> from_, to_;
    std::uint32_t count_[3][1 << digit_bits];
};

template <int Dim>
void LabelSort::operator()(const CandidateList<Dim>& in, int label_bits, Form form,
                           CandidateList<Dim>& out) {
    const int n = in.n, passes = label_bits <= digit_bits       ? 1
                                 : label_bits <= 2 * digit_bits ? 2
                                                                : 3;
    const int width = (label_bits + passes - 1) / passes;
    const std::uint32_t mask = (1u << width) - 1;
    for (int pass = 0; pass < passes; ++pass) std::fill_n(count_[pass], mask + 1, 0u);
    const auto digit = [&](int k, int pass) {
        return static_cast<std::uint32_t>(in.label[k]) >> (pass * width) & mask;
    };
    for (int k = 0; k < n; ++k)
        for (int pass = 0; pass < passes; ++pass) ++count_[pass][digit(k, pass)];
    for (int pass = 0; pass < passes; ++pass) {
        std::uint32_t sum = 0;
        for (std::uint32_t b = 0; b <= mask; ++b) sum += std::exchange(count_[pass][b], sum);
    }
    from_.reserve(n), to_.reserve(n);
    int *from = from_.data(), *to = to_.data();
    for (int k = 0; k < n; ++k) to[count_[0][digit(k, 0)]++] = k;
    std::swap(from, to);
    for (int pass = 1; pass < passes; ++pass) {
        for (int k = 0; k < n; ++k) to[count_[pass][digit(from[k], pass)]++] = from[k];
        std::swap(from, to);
    }
    const auto move = [=](const auto* source, auto* target) {
        for (int k = 0; k < n; ++k) target[k] = source[from[k]];
    };
    for (int d = 0; d < Dim; ++d) move(in.x[d], out.x[d]);
    if (form != Form::uniform) move(in.t, out.t);
    if (form == Form::ellipsoids) {
        for (int d = 0; d < Dim; ++d) move(in.width[d], out.width[d]);
        for (int s = 1; s < metric_size<Dim>; ++s) move(in.metric[s], out.metric[s]);
    }
    move(in.label, out.label);
    out.n = n;
    for (int k = n; k < n + list_slack; ++k) {
        for (int d = 0; d < Dim; ++d) out.x[d][k] = 1e30f;
        out.t[k] = 0;
        if (form == Form::ellipsoids)
            for (float* entry : out.metric) entry[k] = 0;
        out.label[k] = no_label;
    }
}

}  // namespace connectivity::detail
