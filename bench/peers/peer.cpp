// SPDX-License-Identifier: BSD-3-Clause
#include "peer.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace connectivity::bench {

const Peer* peer_named(const std::string& name) {
    for (const Peer& peer : peers())
        if (peer.name == name) return &peer;
    return nullptr;
}

bool has_constant_R(const CaseName& c) {
    return c.workload[0] == 'W' && c.workload != "W3" && c.workload != "W7";
}

double nodes_of(const CaseName& c) {
    if (!c.size.empty()) return std::stod(c.size);
    return c.workload == "W2" ? 1e5 : 1e6;
}

PeerContestant::PeerContestant(const Input& input, Form form, bool exact)
    : input_(input), rows_(form == Form::rows), exact_(exact) {
    if (form == Form::both) throw std::invalid_argument("peers build rows or pairs, not both");
    PeerContestant::place(0);
}

void PeerContestant::place(int state) {
    state_ = state;
    if (cloud().dim == 3) return;
    xyz_.resize(3 * cloud().R.size());
    for (std::size_t k = 0; k < cloud().R.size(); ++k) {
        xyz_[3 * k] = x()[2 * k];
        xyz_[3 * k + 1] = x()[2 * k + 1];
    }
}

const double* PeerContestant::xyz() const { return cloud().dim == 3 ? x() : xyz_.data(); }

bool PeerContestant::is_near_boundary(Offset i, Offset j) const {
    double r2 = 0;
    for (int d = 0; d < cloud().dim; ++d) {
        const double r = x()[i * cloud().dim + d] - x()[j * cloud().dim + d];
        r2 += r * r;
    }
    const auto& all = cloud().R;
    const double reach =
        std::max(all[static_cast<std::size_t>(i)], all[static_cast<std::size_t>(j)]);
    return std::abs(std::sqrt(r2) - reach) <= 1e-4 * reach;
}

bool PeerContestant::agrees(Offset node, const std::vector<Offset>& neighbours) const {
    std::vector<Offset> found = partners(node), differing;
    std::sort(found.begin(), found.end());
    std::set_symmetric_difference(found.begin(), found.end(), neighbours.begin(), neighbours.end(),
                                  std::back_inserter(differing));
    return std::all_of(differing.begin(), differing.end(),
                       [&](Offset other) { return !exact_ && is_near_boundary(node, other); });
}

}  // namespace connectivity::bench
