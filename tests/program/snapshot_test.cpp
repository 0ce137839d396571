// SPDX-License-Identifier: BSD-3-Clause
// A real snapshot: GADGET-4's lcdm_gas at z = 0, with the smoothing lengths and densities of that
// code. Rows are compared with all distances between all nodes.
#include <atomic>
#include <cmath>
#include <thread>

#include <gtest/gtest.h>

#include <program/run_program.hpp>

namespace connectivity::test {
namespace {

constexpr double box = 50000;

/// Nodes of several types laid end to end, axis by axis so that the compiler can vectorise.
struct Nodes {
    std::vector<double> x, y, z, reach2;  ///< reach2 < 0: sees nobody

    std::size_t size() const { return x.size(); }
    void add(const PlainFile& file, const std::string& type) {
        const auto positions = file.read<float>(type + "/Coordinates");
        const bool sees = file.has(type + "/SmoothingLength");
        const auto h = sees ? file.read<float>(type + "/SmoothingLength") : std::vector<float>{};
        for (std::size_t i = 0; i < positions.size() / 3; ++i) {
            x.push_back(positions[3 * i]);
            y.push_back(positions[3 * i + 1]);
            z.push_back(positions[3 * i + 2]);
            reach2.push_back(sees ? static_cast<double>(h[i]) * static_cast<double>(h[i]) : -1);
        }
    }
};

/// Distance along a periodic axis for coordinates inside the box.
double nearest(double d) {
    const double a = std::abs(d);
    return a < box - a ? a : box - a;
}

/// Neighbours of node i that come after it, ascending: all distances, no search.
std::vector<int> later_neighbours(const Nodes& nodes, std::size_t i) {
    constexpr std::size_t block = 256;
    const double xi = nodes.x[i], yi = nodes.y[i], zi = nodes.z[i], own = nodes.reach2[i];
    std::vector<int> found;
    double excess[block];  // of the squared distance over the larger squared reach
    for (std::size_t first = i + 1; first < nodes.size(); first += block) {
        const std::size_t n = std::min(block, nodes.size() - first);
        const double *x = &nodes.x[first], *y = &nodes.y[first], *z = &nodes.z[first],
                     *reach2 = &nodes.reach2[first];
        for (std::size_t k = 0; k < n; ++k) {
            const double dx = nearest(x[k] - xi), dy = nearest(y[k] - yi), dz = nearest(z[k] - zi);
            excess[k] = dx * dx + dy * dy + dz * dz - std::max(own, reach2[k]);
        }
        if (*std::min_element(excess, excess + n) > 0) continue;
        for (std::size_t k = 0; k < n; ++k)
            if (excess[k] <= 0) found.push_back(static_cast<int>(first + k));
    }
    return found;
}

using Rows = std::vector<std::vector<int>>;

Rows all_later_neighbours(const Nodes& nodes) {
    Rows later(nodes.size());
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t i; (i = next.fetch_add(1)) < nodes.size();)
            later[i] = later_neighbours(nodes, i);
    };
    std::thread second(work);
    work();
    second.join();
    return later;
}

/// Rows of a result file: segments of all lists of a node stand one after the other.
struct Result {
    std::vector<std::int64_t> offsets;
    std::vector<int> slots, i, j;
    std::size_t n_lists;

    explicit Result(const std::string& path) {
        const auto file = PlainFile::open(path);
        offsets = file.read<std::int64_t>("rows/offsets");
        slots = file.read<int>("rows/slots");
        i = file.read<int>("pairs/i");
        j = file.read<int>("pairs/j");
        n_lists = file.strings("/", "list_names").size();
    }
    std::vector<int> row(std::size_t r) const {
        return {slots.begin() + offsets[r * n_lists], slots.begin() + offsets[(r + 1) * n_lists]};
    }
};

/// Every row and every pair against all distances between all nodes.
void expect_brute_force(const Result& result, const Nodes& nodes) {
    ASSERT_EQ(result.offsets.size(), nodes.size() * result.n_lists + 1);
    const Rows later = all_later_neighbours(nodes);
    Rows rows(nodes.size());
    std::vector<int> pair_i, pair_j;
    std::size_t different = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (const int j : later[i]) {
            rows[static_cast<std::size_t>(j)].push_back(static_cast<int>(i));
            pair_i.push_back(static_cast<int>(i));
            pair_j.push_back(j);
        }
        rows[i].insert(rows[i].end(), later[i].begin(), later[i].end());
        different += rows[i] != result.row(i);
    }
    EXPECT_EQ(different, 0u) << "rows differ";
    EXPECT_EQ(result.i, pair_i);
    EXPECT_EQ(result.j, pair_j);
}

class Snapshot : public ::testing::Test {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(path_)) GTEST_SKIP() << path_ << " is not here";
    }
    const std::string path_ = shared_data("data/lcdm_gas_z0.hdf5");
    TemporaryFolder folder_;
};

TEST_F(Snapshot, gas_rows_pairs_and_density_are_those_of_the_file) {
    const auto outcome = run_program(
        {"pairs", path_, "--list", "PartType0", "--density", "--out", folder_ / "r.h5"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("1450630 unique pairs"), std::string::npos) << outcome.out;
    const Result result(folder_ / "r.h5");
    EXPECT_EQ(result.i.size(), 1450630u);
    const auto file = PlainFile::open(path_);
    Nodes nodes;
    nodes.add(file, "PartType0");
    expect_brute_force(result, nodes);

    const auto ours = PlainFile::open(folder_ / "r.h5").read<double>("density/PartType0");
    const auto theirs = file.read<float>("PartType0/Density");
    ASSERT_EQ(ours.size(), theirs.size());
    double sum = 0, largest = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        const double relative = std::abs(ours[i] / static_cast<double>(theirs[i]) - 1);
        sum += relative * relative;
        largest = std::max(largest, relative);
    }
    EXPECT_LE(std::sqrt(sum / static_cast<double>(ours.size())), 2e-6);
    EXPECT_LE(largest, 1.1e-5);
}

TEST_F(Snapshot, pairs_across_gas_and_dark_matter_equal_brute_force) {
    const auto outcome = run_program(
        {"pairs", path_, "--list", "PartType0", "--list", "PartType1", "--out", folder_ / "r.h5"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Result result(folder_ / "r.h5");
    const auto file = PlainFile::open(path_);
    Nodes nodes;
    nodes.add(file, "PartType0");
    nodes.add(file, "PartType1");
    expect_brute_force(result, nodes);
}

TEST_F(Snapshot, gas_alone_is_the_default) {
    ASSERT_EQ(run_program({"pairs", path_, "--out", folder_ / "r.h5"}).status, 0);
    EXPECT_EQ(PlainFile::open(folder_ / "r.h5").strings("/", "list_names"),
              std::vector<std::string>{"PartType0"});
}

}  // namespace
}  // namespace connectivity::test
