// SPDX-License-Identifier: BSD-3-Clause
/// vesin: cell lists for molecules. Double precision; every pair once, two numbers of 8 bytes each,
/// unsorted; no compressed rows. It keeps the memory of its pairs from build to build.
/// Threads of its own, as many as Kokkos has.

#include "peer.hpp"

#include <algorithm>
#include <stdexcept>

#include <vesin.h>

#include <connectivity/base/parallel.hpp>

namespace connectivity::bench {
namespace {

class Vesin final : public PeerContestant {
public:
    Vesin(const Input& input, Form form) : PeerContestant(input, form, true) {
        options_.cutoff = R();
        options_.n_threads = n_workers();
    }
    ~Vesin() override { vesin_free(&found_); }
    Vesin(const Vesin&) = delete;
    Vesin& operator=(const Vesin&) = delete;

    void build() override {
        using Vector = double[3];
        constexpr double open_box[3][3] = {};
        constexpr bool periodic[3] = {};
        const char* why = "";
        const int status =
            vesin_neighbors(reinterpret_cast<const Vector*>(xyz()), static_cast<std::size_t>(n()),
                            open_box, periodic, {VesinCPU, 0}, options_, &found_, &why);
        if (status != 0) throw std::runtime_error(std::string("vesin: ") + why);
    }

    Offset result_bytes() const override {
        return static_cast<Offset>(found_.length * sizeof *found_.pairs);
    }

protected:
    Offset n_entries() const override { return static_cast<Offset>(found_.length); }
    std::vector<Offset> partners(Offset node) const override {
        std::vector<Offset> partners;
        const auto self = static_cast<std::size_t>(node);
        std::for_each(found_.pairs, found_.pairs + found_.length, [&](const auto& pair) {
            if (pair[0] == self || pair[1] == self)
                partners.push_back(static_cast<Offset>(pair[0] == self ? pair[1] : pair[0]));
        });
        return partners;
    }

private:
    VesinOptions options_{};  ///< half, unsorted, numbers only
    VesinNeighborList found_;
};

/// At most 1e5 cells: W4 and W6 at 1e6 nodes take it most of a minute; W5, with its far corners,
/// becomes brute force at any size.
bool takes_part(const CaseName& c) {
    const bool crowded = (c.workload == "W4" || c.workload == "W6") && nodes_of(c) > 1e5;
    return has_constant_R(c) && c.workload != "W5" && !crowded && c.form == "pairs";
}

}  // namespace

std::vector<Peer> vesin_peers() {
    return {{"vesin", "double; flat pairs of 16 bytes, unsorted", true, takes_part,
             [](const Input& input, Form form) -> std::unique_ptr<Contestant> {
                 return std::make_unique<Vesin>(input, form);
             }}};
}

}  // namespace connectivity::bench
