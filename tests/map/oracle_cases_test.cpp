// SPDX-License-Identifier: BSD-3-Clause
// Reference cases decided in exact rational arithmetic: rows, counts, gather, scatter and pairs.

#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <support/case.hpp>
#include <support/shared_data.hpp>

namespace connectivity::test {
namespace {

using nlohmann::json;

const std::string own_file = CONNECTIVITY_SOURCE_DIR "/tests/support/data/connectivity_cases.json";

std::vector<double> flat(const json& rows) {
    std::vector<double> values;
    for (const json& row : rows)
        for (const json& value : row) values.push_back(value.get<double>());
    return values;
}

Case case_of(const json& source) {
    Case c;
    c.dim = source["dim"].get<int>();
    c.text = source["name"].get<std::string>();
    for (const json& list : source["nodeLists"]) {
        ListData data;
        data.name = list["name"].get<std::string>();
        data.n_internal = list["nInternal"].get<Offset>();
        data.extent = list["kernelExtent"].get<double>();
        data.x = flat(list["positions"]);
        data.H = flat(list["H"]);
        data.tensor = true;
        c.lists.push_back(std::move(data));
    }
    const json& stored = source["expected"]["numStored"];
    for (std::size_t k = 0; k < c.lists.size(); ++k)
        c.ghost_rows = c.ghost_rows || stored[k].get<Offset>() != c.lists[k].n_internal;
    return c;
}

/// Rows of a map in the shape of the file: [list][node][list] -> ascending node ids.
json rows_of(const ConnectivityMap& map) {
    const RowsView<> rows = map.rows();
    const SlotLayout& layout = map.layout();
    json all = json::array();
    for (std::size_t k = 0; k < static_cast<std::size_t>(layout.n_lists()); ++k) {
        json nodes = json::array();
        for (Offset r = layout.row_offset()[k]; r < layout.row_offset()[k + 1]; ++r) {
            json segments = json::array();
            for (int l = 0; l < layout.n_lists(); ++l) {
                json ids = json::array();
                for (const Slot j : rows(r, l))
                    ids.push_back(j - layout.list_offset()[static_cast<std::size_t>(l)]);
                segments.push_back(ids);
            }
            nodes.push_back(segments);
        }
        all.push_back(nodes);
    }
    return all;
}

json pairs_of(ConnectivityMap& map) {
    const auto pairs = map.pairs().expanded_view();
    const SlotLayout& layout = map.layout();
    const auto name = [&](json& pair, Slot slot) {
        const int list = layout.list_of_slot(slot);
        pair.push_back(list);
        pair.push_back(slot - layout.list_offset()[static_cast<std::size_t>(list)]);
    };
    json all = json::array();
    for (Offset k = 0; k < pairs.size(); ++k) {
        json pair = json::array();
        name(pair, pairs[k].i);
        name(pair, pairs[k].j);
        all.push_back(pair);
    }
    return all;
}

/// The file lists every node; a map has rows of stored nodes.
json stored_part(json all, const json& n_stored) {
    for (std::size_t k = 0; k < all.size(); ++k)
        while (all[k].size() > n_stored[k].get<std::size_t>()) all[k].erase(all[k].size() - 1);
    return all;
}

void check(const json& source, SearchMethod method) {
    SCOPED_TRACE(source["name"].get<std::string>() + ", " + name_of(method));
    const json& want = source["expected"];
    Case c = case_of(source);
    EXPECT_EQ(c.kernel_extent(), want["K_used"].get<double>());
    ConnectivityMap map;
    rebuild(map, c, method);
    EXPECT_EQ(rows_of(map), stored_part(want["neighbors"], want["numStored"]));
    EXPECT_EQ(pairs_of(map), want["pairs"]);
    for (std::size_t k = 0; k < c.lists.size(); ++k)
        for (Offset a = 0; a < want["numStored"][k].get<Offset>(); ++a)
            EXPECT_EQ(map.rows()[map.layout().row_offset()[k] + a].size(),
                      want["numNeighbors"][k][static_cast<std::size_t>(a)].get<Offset>());
    c.mode = SearchMode::gather;
    rebuild(map, c, method);
    EXPECT_EQ(rows_of(map), stored_part(want["gather"], want["numStored"]));
    c.mode = SearchMode::scatter;
    rebuild(map, c, method);
    EXPECT_EQ(rows_of(map), stored_part(want["scatter"], want["numStored"]));
}

void check_file(std::ifstream& file) {
    const json cases = json::parse(file)["cases"];
    ASSERT_GT(cases.size(), 0u);
    for (const json& source : cases)
        for (const SearchMethod method : all_methods) check(source, method);
}

TEST(OracleCases, rows_counts_gather_scatter_and_pairs_are_the_exact_ones) {
    std::ifstream file(own_file);
    ASSERT_TRUE(file) << own_file;
    check_file(file);
}

TEST(OracleCases, the_full_reference_file_holds_too) {
    std::ifstream file(shared_data("oracle/connectivity_cases.json"));
    if (!file) GTEST_SKIP() << "no reference data beside the repository: " << shared_data("");
    check_file(file);
}

}  // namespace
}  // namespace connectivity::test
