// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// How strongly the two nodes of a pair act on each other: a factor in [0, 1] for each pair, stored
/// only where somebody sets one.
///
/// Invariant: values that exist are all in [0, 1]. A call that throws leaves the old ones. Views
/// handed out stay valid and unchanged. Cost: 8 bytes a pair, as much again once a functor has set
/// it twice (the next setting then allocates nothing).

#include <memory>
#include <span>
#include <type_traits>

#include <connectivity/base/spaces.hpp>

namespace connectivity {

/// Refers to any double f(Slot i, Slot j), as two pointers; f is called for i before j, from
/// several threads at once, and has to outlive the reference. One indirect call a half row.
class NodeCoupling {
public:
    template <class F,
              class = std::enable_if_t<
                  !std::is_same_v<std::remove_cvref_t<F>, NodeCoupling> &&
                  std::is_object_v<std::remove_reference_t<F>> &&
                  std::is_invocable_r_v<double, const std::remove_reference_t<F>&, Slot, Slot>>>
    NodeCoupling(const F& f)
        : object_(std::addressof(f)),
          call_([](const void* object, Slot i, std::span<const Slot> j, double* values) {
              const F& function = *static_cast<const F*>(object);
              for (std::size_t k = 0; k < j.size(); ++k) values[k] = function(i, j[k]);
          }) {}

    /// values[k] = f(i, j[k])
    void operator()(Slot i, std::span<const Slot> j, double* values) const {
        call_(object_, i, j, values);
    }

private:
    const void* object_;
    void (*call_)(const void*, Slot, std::span<const Slot>, double*);
};

/// Pairs as NodePairList has them.
struct HalfRows {
    ConstView<Offset> offsets;  ///< [n_slots + 1]
    ConstView<Slot> j;          ///< [n_pairs]
    ConstView<Slot> nodes;      ///< [n_slots]: whose half row it is; empty: slot by slot

    Slot node(Offset row) const { return nodes.size() > 0 ? nodes(row) : static_cast<Slot>(row); }
};

/// The stored factors of one pair list, for NodePairList.
class PairCoupling {
public:
    bool exists() const { return exists_; }
    /// [n_pairs], host; empty where there are none, which means 1.
    ConstView<double> values() const;
    double operator[](Offset k) const { return exists_ ? values_(k) : 1.0; }
    Offset bytes() const;

    /// Sets all pairs. Throws Error{argument} for the first pair whose value is
    /// not in [0, 1], Error{memory}, and what f throws.
    void set(const HalfRows& pairs, const NodeCoupling& f);

    /// The same from values [n_pairs], in the order of the pairs: one pass, without a look-up.
    void set(const HalfRows& pairs, std::span<const double> values);

    /// Sets pair k; the others stay (1 where there are none yet). Throws Error{argument},
    /// Error{memory}.
    void set(const HalfRows& pairs, Offset k, double value);

    /// Forgets the values and gives their memory back.
    void clear() noexcept;
    /// Forgets the values; memory that was in use stays for the next ones.
    void drop() noexcept;

    /// Values of surviving pairs in their new order, in two steps: new_to_old [n_new_pairs]. The
    /// first throws Error{memory}, the second cannot fail.
    void prepare_remap(const ConstView<Offset>& new_to_old);
    void commit_remap() noexcept;
    void abandon_remap() noexcept { pending_ = {}; }

private:
    template <class Fill>
    void fill_all(const HalfRows& pairs, const Fill& fill);

    View<double> values_, spare_, pending_;
    Offset n_ = 0, n_pending_ = 0;
    bool exists_ = false;
};

}  // namespace connectivity
