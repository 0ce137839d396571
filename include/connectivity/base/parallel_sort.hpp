// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Sorting on the host's threads.
///
/// Invariant: `less` is a strict total order, so the result does not depend on the number of
/// threads. Cost: O(n log n) comparisons shared by all threads, then log2(threads) merges of n
/// elements, each pair of runs by one thread; n elements of scratch memory.

#include <algorithm>

#include <connectivity/base/parallel.hpp>

namespace connectivity {

/// Sorts the first n elements of `data`, with `scratch` of the same size; `less` must not throw.
/// The two Views may change places.
template <class T, class Less>
void parallel_sort(View<T>& data, View<T>& scratch, Offset n, const Less& less) {
    Offset runs = 1;
    while (runs < n_workers() && n / (2 * runs) >= few_items) runs *= 2;
    const auto begin = [=](Offset run, Offset of) { return n / of * run + n % of * run / of; };
    T* const values = data.data();
    for_each_dynamic("base/sort/runs", runs, [&](int, Offset run) {
        std::sort(values + begin(run, runs), values + begin(run + 1, runs), less);
    });
    for (Offset left = runs; left > 1; left /= 2) {
        const T* const from = data.data();
        T* const to = scratch.data();
        for_each_dynamic("base/sort/merge", left / 2, [&](int, Offset k) {
            const Offset first = begin(2 * k, left), middle = begin(2 * k + 1, left),
                         last = begin(2 * k + 2, left);
            std::merge(from + first, from + middle, from + middle, from + last, to + first, less);
        });
        std::swap(data, scratch);
    }
}

}  // namespace connectivity
