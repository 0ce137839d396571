// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Other neighbour searches in the rebuild benchmark: one source file each in this folder, one line
/// each in bench/CMakeLists.txt. Who was found when the build was configured takes part.
///
/// Every peer is given the caller's shuffled positions in every build, the threads that Kokkos has,
/// and keeps what its interface lets it keep from build to build. It delivers what it delivers
/// (Peer::delivers); rows or pairs of others that are unsorted or not compressed stay so.
/// Their sources are compiled for the processor at hand, as their users would; ours are not.

#include <memory>
#include <string>
#include <vector>

#include "../cases.hpp"
#include "../contestants.hpp"

namespace connectivity::bench {

struct Peer {
    std::string name;      ///< [a-z_]+, the first part of its cases' names
    std::string delivers;  ///< precision, form and order, for the table
    bool exact;            ///< compares in double precision: its counts have to be right
    bool (*takes_part)(const CaseName&);
    std::unique_ptr<Contestant> (*make)(const Input&, Form);
};

/// Those that were found, in the order of bench/CMakeLists.txt.
const std::vector<Peer>& peers();

/// Null for ours and the yardstick.
const Peer* peer_named(const std::string& name);

bool has_constant_R(const CaseName& c);  ///< W1, W2, W4, W5 and W6
double nodes_of(const CaseName& c);      ///< of W1 ... W7, about

/// Positions and checks that peers share. A build has entries: those of the rows, or one a pair.
class PeerContestant : public Contestant {
public:
    PeerContestant(const Input& input, Form form, bool exact);

    void place(int state) override;
    Offset n_row_entries() const final { return rows_ ? n_entries() : 0; }
    Offset n_pairs() const final { return rows_ ? 0 : n_entries(); }

    /// Of who compares in single precision, neighbours within 1e-4 R of the boundary are not
    /// judged.
    bool agrees(Offset node, const std::vector<Offset>& neighbours) const final;

protected:
    virtual Offset n_entries() const = 0;
    /// By the caller's numbers, in any order: what the last build has beside the node.
    virtual std::vector<Offset> partners(Offset node) const = 0;

    const Cloud& cloud() const { return input_.cloud; }
    Offset n() const { return input_.cloud.n; }
    double R() const { return input_.cloud.R[0]; }  ///< of all nodes, where it is constant
    bool rows() const { return rows_; }
    const double* x() const { return input_.x(state_); }
    const double* xyz() const;  ///< three components a node, z = 0 in 2D

private:
    bool is_near_boundary(Offset i, Offset j) const;

    const Input& input_;
    bool rows_, exact_;
    int state_ = 0;
    std::vector<double> xyz_;  ///< in 2D
};

/// Partners of a node in compressed sparse rows; `half`: also the rows that name it.
template <class Offsets, class Values>
std::vector<Offset> partners_in(const Offsets& offsets, const Values& values, Offset n, Offset node,
                                bool half) {
    std::vector<Offset> found;
    for (Offset i = half ? 0 : node; i < (half ? n : node + 1); ++i)
        for (auto k = offsets[i]; k < offsets[i + 1]; ++k) {
            const auto j = static_cast<Offset>(values[k]);
            if (i == node)
                found.push_back(j);
            else if (j == node)
                found.push_back(i);
        }
    return found;
}

}  // namespace connectivity::bench
