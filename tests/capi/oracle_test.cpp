// SPDX-License-Identifier: BSD-3-Clause
// Reference cases decided in exact rational arithmetic, through the C interface.

#include <fstream>

#include <nlohmann/json.hpp>

#include <support/shared_data.hpp>
#include "capi_support.hpp"

namespace connectivity::test {
namespace {

using nlohmann::json;

constexpr int all_methods[] = {CONN_METHOD_AUTOMATIC, CONN_METHOD_BRUTE, CONN_METHOD_CELLS,
                               CONN_METHOD_GROUPS, CONN_METHOD_DEVICE};

std::vector<double> flat(const json& rows) {
    std::vector<double> values;
    for (const json& row : rows)
        for (const json& value : row) values.push_back(value.get<double>());
    return values;
}

std::vector<NodeSet> sets_of(const json& source) {
    std::vector<NodeSet> sets;
    for (const json& list : source["nodeLists"]) {
        NodeSet set;
        set.name = list["name"].get<std::string>();
        set.x = flat(list["positions"]);
        set.H = flat(list["H"]);
        set.n_internal = list["nInternal"].get<std::int64_t>();
        set.extent = list["kernelExtent"].get<double>();
        sets.push_back(set);
    }
    return sets;
}

/// Neighbour ids [list][node][list] of the file as rows of slots.
std::vector<std::vector<std::int32_t>> slots_of(const json& all, const json& n_stored,
                                                const std::vector<std::int32_t>& list_offset) {
    std::vector<std::vector<std::int32_t>> rows;
    for (std::size_t k = 0; k < all.size(); ++k)
        for (std::size_t a = 0; a < n_stored[k].get<std::size_t>(); ++a) {
            rows.emplace_back();
            for (std::size_t l = 0; l < all[k][a].size(); ++l)
                for (const json& id : all[k][a][l])
                    rows.back().push_back(list_offset[l] + id.get<std::int32_t>());
        }
    return rows;
}

void check(const Context& context, const json& source, int method) {
    SCOPED_TRACE(source["name"].get<std::string>() + ", method " + std::to_string(method));
    const json& want = source["expected"];
    const int dim = source["dim"].get<int>();
    const std::vector<NodeSet> sets = sets_of(source);
    std::vector<std::int32_t> list_offset{0};
    for (const NodeSet& set : sets)
        list_offset.push_back(list_offset.back() + static_cast<std::int32_t>(set.x.size()) / dim);

    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.method = method;
    for (std::size_t k = 0; k < sets.size(); ++k)
        if (want["numStored"][k].get<std::int64_t>() != sets[k].n_internal) options.ghost_rows = 1;
    Lists expected;
    expected.rows = slots_of(want["neighbors"], want["numStored"], list_offset);
    for (const json& p : want["pairs"])
        expected.pairs.emplace_back(list_offset[p[0].get<std::size_t>()] + p[1].get<int>(),
                                    list_offset[p[2].get<std::size_t>()] + p[3].get<int>());
    const Lists found = lists_of(context, dim, sets, options);
    EXPECT_EQ(found.rows, expected.rows);
    EXPECT_EQ(found.pairs, expected.pairs);
    std::size_t r = 0;
    for (std::size_t k = 0; k < sets.size(); ++k)
        for (std::size_t a = 0; a < want["numStored"][k].get<std::size_t>(); ++a, ++r)
            EXPECT_EQ(found.rows[r].size(), want["numNeighbors"][k][a].get<std::size_t>());

    options.pairs = 0;
    options.mode = CONN_GATHER;
    EXPECT_EQ(lists_of(context, dim, sets, options).rows,
              slots_of(want["gather"], want["numStored"], list_offset));
    options.mode = CONN_SCATTER;
    EXPECT_EQ(lists_of(context, dim, sets, options).rows,
              slots_of(want["scatter"], want["numStored"], list_offset));
}

void check_file(std::ifstream& file) {
    const Context context;
    const json cases = json::parse(file)["cases"];
    int n_checked = 0;
    for (const json& source : cases)
        for (const int method : all_methods) check(context, source, method), ++n_checked;
    EXPECT_GE(n_checked, 16);
}

TEST(CapiOracle, rows_counts_gather_scatter_and_pairs_are_the_exact_ones) {
    std::ifstream file(CONNECTIVITY_SOURCE_DIR "/tests/support/data/connectivity_cases.json");
    ASSERT_TRUE(file) << "tests/support/data/connectivity_cases.json is missing";
    check_file(file);
}

TEST(CapiOracle, the_full_reference_file_holds_too) {
    std::ifstream file(connectivity::test::shared_data("oracle/connectivity_cases.json"));
    if (!file)
        GTEST_SKIP() << "no reference data beside the repository: "
                     << connectivity::test::shared_data("");
    check_file(file);
}

}  // namespace
}  // namespace connectivity::test
