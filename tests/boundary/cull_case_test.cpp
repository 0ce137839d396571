// SPDX-License-Identifier: BSD-3-Clause
// A reference case of culling, decided by hand: flags, new ids, boundaries afterwards.

#include <gtest/gtest.h>

#include <boundary/clouds.hpp>
#include <support/reference_cases.hpp>

namespace connectivity::test {
namespace {

using nlohmann::json;

class CullCase : public ::testing::Test {
protected:
    GhostLists ghosts() const {
        GhostLists ghosts;
        ghosts.reset({case_.lists[0].n_internal, case_.lists[1].n_internal});
        for (const json& boundary : source_["boundaries"]) {
            ghosts.begin_way(true);
            for (int list = 0; list < 2; ++list) {
                const auto controls =
                    boundary["control"][static_cast<std::size_t>(list)].get<std::vector<Slot>>();
                std::copy(controls.begin(), controls.end(),
                          ghosts.append(list, static_cast<Offset>(controls.size())));
            }
        }
        ghosts.finish();
        return ghosts;
    }

    View<Slot> named() {
        rebuild(map_, case_);
        auto keep = allocate_zeroed<Slot>("keep", case_.n_slots());
        const RowsView<> rows = map_.rows();
        for (Offset k = 0; k < rows.size(); ++k) keep(rows.slots(k)) = 1;
        return keep;
    }

    /// Per list, as the file has it.
    json by_list(const View<Slot>& values) const {
        json all = json::array();
        Offset first = 0;
        for (std::size_t list = 0; list < 2; first += case_.n(list++))
            all.push_back(
                std::vector<Slot>(values.data() + first, values.data() + first + case_.n(list)));
        return all;
    }

    static json boundaries_of(const GhostLists& ghosts) {
        json all = json::array();
        for (int way = 0; way < ghosts.n_ways(); ++way) {
            json boundary = {{"control", json::array()}, {"ghost", json::array()}};
            for (int list = 0; list < 2; ++list) {
                const GhostBlock& block = ghosts.block(way, list);
                json control = json::array(), ghost = json::array();
                for (Offset k = 0; k < block.n; ++k) {
                    control.push_back(block.controls()(k));
                    ghost.push_back(block.first + k);
                }
                boundary["control"].push_back(control);
                boundary["ghost"].push_back(ghost);
            }
            all.push_back(boundary);
        }
        return all;
    }

    const json source_ = reference_case("c08");
    const Case case_ = case_of(source_);
    ConnectivityMap map_;
};

TEST_F(CullCase, flags_new_ids_and_boundaries_are_those_of_the_reference) {
    GhostLists lists = ghosts();
    EXPECT_EQ(boundaries_of(lists), source_["boundaries"]);
    const View<Slot> keep = named(), old2new = allocate<Slot>("old2new", case_.n_slots());
    lists.keep_needed(keep, CullRule::controls_as_made);
    EXPECT_EQ(by_list(keep), source_["patch"]["flags"]);
    EXPECT_EQ(lists.renumber(keep, old2new), 5);
    EXPECT_EQ(by_list(old2new), source_["patch"]["old2new"]);
    lists.drop(keep, old2new);
    EXPECT_EQ(boundaries_of(lists), source_["patch"]["boundaries_after"]);
    EXPECT_EQ(lists.n(0), 14 - source_["patch"]["removed"][0].get<Offset>());
    EXPECT_EQ(lists.n(1), 3 - source_["patch"]["removed"][1].get<Offset>());
}

/// Node 6 of the first list is control of node 11 only, which nobody names.
TEST_F(CullCase, the_stricter_rule_also_drops_what_was_only_control_of_a_dropped_ghost) {
    const GhostLists lists = ghosts();
    const View<Slot> keep = named();
    lists.keep_needed(keep, CullRule::controls_of_kept);
    json want = source_["patch"]["flags"];
    EXPECT_EQ(want[0][6].get<int>(), 1);
    want[0][6] = 0;
    EXPECT_EQ(by_list(keep), want);
}

/// The ghosts of the first list are mirror images; those of the second are invented.
TEST_F(CullCase, given_controls_make_the_ghosts_of_the_reference) {
    const json& wanted = source_["boundaries"];
    Boundaries boundaries(2);
    const std::vector<double> origin{0, 0};
    for (std::size_t b = 0; b < 2; ++b) {
        const std::vector<double> normal{b == 0 ? 1.0 : 0.0, b == 0 ? 0.0 : 1.0};
        boundaries.add(Boundary::given("given", 2, RigidMap::mirror(Plane(2, origin, normal)),
                                       [&wanted, b](int, Offset, std::vector<Slot>& controls) {
                                           controls =
                                               wanted[b]["control"][0].get<std::vector<Slot>>();
                                       }));
    }
    Case internal = case_;
    internal.lists.pop_back();
    internal.lists[0].x.resize(8), internal.lists[0].H.resize(12);
    boundaries.make(node_lists(internal), MapOptions{});
    const Case made = copy_of(boundaries.lists());
    EXPECT_EQ(made.lists[0].x, case_.lists[0].x);
    EXPECT_EQ(made.lists[0].H, case_.lists[0].H);
    EXPECT_EQ(made.lists[0].n_internal, 4);
    for (int way = 0; way < 2; ++way) {
        const GhostBlock& block = boundaries.ghosts().block(way, 0);
        for (Offset k = 0; k < block.n; ++k)
            EXPECT_EQ(block.first + k,
                      wanted[static_cast<std::size_t>(way)]["ghost"][0][static_cast<std::size_t>(k)]
                          .get<Offset>());
    }
    // 13 is the mirror image of 5, which is the one of 2.
    EXPECT_EQ(boundaries.lists()[0].owners()(13 - 4), 2);
}

}  // namespace
}  // namespace connectivity::test
