// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Who takes part in the rebuild benchmark, and what each of them builds.
///
/// All contestants get the same points, in the same shuffled order. Ours are compressed sparse rows
/// by the caller's numbers: `rows` sorted, with both directions of every pair; `pairs` with every
/// pair once. Peers find the same neighbours, in a form of their own: peers/peer.hpp.

#include <memory>
#include <string>
#include <vector>

#include <connectivity/base/types.hpp>

#include "scenes.hpp"

namespace connectivity::bench {

enum class Form { rows, pairs, both };

Form form_of(const std::string& name);  ///< "rows", "pairs" or "both"

/// What the contestants of a group are given.
struct Input {
    Cloud cloud;
    std::vector<std::vector<double>> moved;  ///< displaced positions; empty where nothing may move
    std::vector<double> H;                   ///< of the variant `tensor`

    /// State 0 is the cloud itself; states 1 ... n_moved() are displaced from it.
    int n_moved() const { return static_cast<int>(moved.size()); }
    const double* x(int state) const {
        return state == 0 ? cloud.x.data() : moved[static_cast<std::size_t>(state - 1)].data();
    }
};

/// A cloud with four displaced states; with tensors beside its radii if told.
Input make_input(const std::string& cloud, bool tensor);

class Contestant {
public:
    virtual ~Contestant() = default;
    virtual void place(int state) = 0;  ///< which positions the next builds see; free of cost
    virtual void build() = 0;
    virtual Offset n_row_entries() const = 0;  ///< of the last build, 0 if rows are not built
    virtual Offset n_pairs() const = 0;        ///< of the last build, 0 if pairs are not built
    virtual Offset result_bytes() const = 0;   ///< offsets and values of the lists delivered
    /// Whether the lists name exactly these (ascending) neighbours; who cannot tell agrees.
    virtual bool agrees(Offset, const std::vector<Offset>&) const { return true; }
    virtual double check_ms() const { return 0; }  ///< of the last build: reading, checking input
    virtual int n_steps() const { return 1; }      ///< of a host, that a build takes
    virtual int n_rebuilds() const { return 1; }   ///< in these
};

/// Variants `key`, `overlap` and `intersection`: rows, pairs and that product, too.
bool is_feature(const std::string& variant);

/// `who` is "ours" or a peer, `variant` of ours: see cases.hpp. The input has to outlive the
/// contestant, which stands at state 0. Starts the runtime.
std::unique_ptr<Contestant> make_contestant(const std::string& who, const std::string& variant,
                                            const Input& input, Form form);

}  // namespace connectivity::bench
