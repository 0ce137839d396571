// SPDX-License-Identifier: BSD-3-Clause
// A periodic domain by ghosts that the caller shifts, in an open domain, against the periodic map:
// the same neighbours, but where rounding of a shifted position decides.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

/// A case in which all nodes are internal and lie in the box, with its images as ghosts.
struct Imaged {
    Case c;                                ///< open
    std::vector<std::vector<Slot>> owner;  ///< by list and node: slot of the node in the original
};

void move_inside(Case& c) {
    for (ListData& list : c.lists) {
        for (std::size_t k = 0; k < list.x.size(); ++k) {
            const auto d = k % static_cast<std::size_t>(c.dim);
            if (!c.domain.periodic[d]) continue;
            const double length = c.domain.hi[d] - c.domain.lo[d];
            list.x[k] -= length * std::floor((list.x[k] - c.domain.lo[d]) / length);
            list.x[k] = std::clamp(list.x[k], c.domain.lo[d], c.domain.hi[d]);
        }
        list.n_internal = static_cast<Offset>(list.x.size()) / c.dim;
    }
}

/// No support is longer than half a box: an image farther outside than that sees no internal node,
/// and none sees it.
bool is_within_reach(const Case& c, const double* x) {
    for (int d = 0; d < c.dim; ++d) {
        const auto axis = static_cast<std::size_t>(d);
        const double reach = 0.5 * c.domain.length(d) * (1 + 1e-6);
        if (c.domain.periodic[axis] &&
            (x[d] < c.domain.lo[axis] - reach || x[d] > c.domain.hi[axis] + reach))
            return false;
    }
    return true;
}

/// Appends node `node` of a list, shifted by so many boxes, unless no one can see it.
bool append_image(const Case& c, const ListData& from, Offset node, const std::array<int, 3>& boxes,
                  ListData& to) {
    double x[3] = {0, 0, 0};
    for (int d = 0; d < c.dim; ++d) {
        x[d] = from.x[static_cast<std::size_t>(node * c.dim + d)] +
               boxes[static_cast<std::size_t>(d)] * c.domain.length(d);
    }
    if (!is_within_reach(c, x)) return false;
    to.x.insert(to.x.end(), x, x + c.dim);
    if (from.tensor) {
        const double* const H = from.H.data() + node * n_symmetric(c.dim);
        to.H.insert(to.H.end(), H, H + n_symmetric(c.dim));
    } else {
        to.h.push_back(from.h[static_cast<std::size_t>(node)]);
    }
    return true;
}

Imaged with_images(const Case& c) {
    Imaged out{c, {}};
    out.c.domain = {};
    Slot first = 0;
    for (std::size_t l = 0; l < c.lists.size(); ++l) {
        std::vector<Slot>& owner = out.owner.emplace_back();
        const auto n = static_cast<Slot>(c.n(l));
        for (Slot a = 0; a < n; ++a) owner.push_back(first + a);
        for (int code = 0; code < 27; ++code) {
            const std::array<int, 3> boxes{code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1};
            bool is_image = code != 13;  // 13: the node itself
            for (std::size_t d = 0; d < 3; ++d)
                is_image = is_image &&
                           (boxes[d] == 0 || (static_cast<int>(d) < c.dim && c.domain.periodic[d]));
            for (Slot a = 0; is_image && a < n; ++a)
                if (append_image(c, c.lists[l], a, boxes, out.c.lists[l]))
                    owner.push_back(first + a);
        }
        first += n;
    }
    return out;
}

using Rows = std::vector<std::vector<Slot>>;

Rows rows_of(const ConnectivityMap& map) {
    Rows rows;
    for (Offset r = 0; r < map.rows().n_rows(); ++r)
        rows.emplace_back(map.rows()[r].begin(), map.rows()[r].end());
    return rows;
}

/// Ghosts by the names of their owners; rows of the internal nodes are those of the original.
Rows mapped_back(const Rows& rows, const Imaged& imaged) {
    std::vector<Slot> owner;
    for (const auto& of_list : imaged.owner)
        owner.insert(owner.end(), of_list.begin(), of_list.end());
    Rows back = rows;
    for (std::vector<Slot>& row : back) {
        for (Slot& j : row) j = owner[static_cast<std::size_t>(j)];
        std::sort(row.begin(), row.end());
    }
    return back;
}

struct Node {
    const ListData* list;
    std::size_t id;
};

Node node_of(const Case& c, Slot slot) {
    std::size_t list = 0;
    while (slot >= c.n(list)) slot -= static_cast<Slot>(c.n(list++));
    return {&c.lists[list], static_cast<std::size_t>(slot)};
}

using Vector = std::array<long double, 3>;

/// |H r| / K, or |r| / (K h); `steepest` becomes the largest change of it with a length.
long double eta_over_K(const Case& c, const Node& node, const Vector& r, long double& steepest) {
    const long double K = c.kernel_extent();
    long double sum = 0;
    if (!node.list->tensor) {
        const long double h = node.list->h[node.id];
        for (const long double component : r) sum += component * component;
        steepest = 1 / (K * h);
        return h > 0 ? std::sqrt(sum) / (K * h) : HUGE_VALL;
    }
    const auto dim = static_cast<std::size_t>(c.dim);
    const double* packed = node.list->H.data() + node.id * dim * (dim + 1) / 2;
    long double H[3][3] = {}, norm2 = 0;
    for (std::size_t a = 0; a < dim; ++a)
        for (std::size_t b = a; b < dim; ++b) H[a][b] = H[b][a] = *packed++;
    for (std::size_t a = 0; a < dim; ++a) {
        long double component = 0;
        for (std::size_t b = 0; b < dim; ++b) {
            component += H[a][b] * r[b];
            norm2 += H[a][b] * H[a][b];
        }
        sum += component * component;
    }
    steepest = std::sqrt(norm2) / K;
    return std::sqrt(sum) / K;
}

/// Whether one of the two stands within 4 ulp of the rim of the other's support. With `shifted` the
/// ulp is that of the largest coordinate, carried to eta; without, that of eta itself.
bool is_at_rim(const Case& c, Slot i, Slot j, bool shifted) {
    const Node a = node_of(c, i), b = node_of(c, j);
    Vector r{0, 0, 0};
    long double largest = 0;
    for (std::size_t d = 0; d < static_cast<std::size_t>(c.dim); ++d) {
        const auto dim = static_cast<std::size_t>(c.dim);
        const long double x = a.list->x[a.id * dim + d], y = b.list->x[b.id * dim + d],
                          length = c.domain.length(static_cast<int>(d));
        r[d] = length > 0 ? (x - y) - length * std::rint((x - y) / length) : x - y;
        largest = std::max({largest, std::abs(x) + length, std::abs(y) + length});
    }
    for (const Node& node : {a, b}) {
        long double steepest = 0;
        const long double eta = eta_over_K(c, node, r, steepest);
        const long double unit = shifted ? std::max(1.0L, largest * steepest) : 1.0L;
        if (std::abs(eta - 1) <= 4 * 0x1p-52L * unit) return true;
    }
    return false;
}

struct Compared {
    Offset entries = 0;  ///< of the periodic map
    Offset at_rim = 0;   ///< of these, within 4 ulp
    Offset differ = 0;   ///< entries that one map has and the other has not, at the rim
    Offset wrong = 0;    ///< such entries elsewhere
    Compared& operator+=(const Compared& other) {
        entries += other.entries, at_rim += other.at_rim;
        differ += other.differ, wrong += other.wrong;
        return *this;
    }
};

/// c: all nodes internal and in the box.
Compared compare(const Case& c, bool shifted, SearchMethod method) {
    const Imaged imaged = with_images(c);
    ConnectivityMap periodic, open;
    rebuild(periodic, c, method);
    rebuild(open, imaged.c, method);
    const Rows want = rows_of(periodic), got = mapped_back(rows_of(open), imaged);
    EXPECT_EQ(want.size(), got.size());
    Compared result;
    for (std::size_t i = 0; i < want.size() && i < got.size(); ++i) {
        const auto slot = static_cast<Slot>(i);
        for (const Slot j : want[i]) result.at_rim += is_at_rim(c, slot, j, shifted);
        result.entries += static_cast<Offset>(want[i].size());
        std::vector<Slot> only;
        std::set_symmetric_difference(want[i].begin(), want[i].end(), got[i].begin(), got[i].end(),
                                      std::back_inserter(only));
        for (const Slot j : only) ++(is_at_rim(c, slot, j, shifted) ? result.differ : result.wrong);
    }
    return result;
}

void record(const Compared& sum) {
    ::testing::Test::RecordProperty("entries", std::to_string(sum.entries));
    ::testing::Test::RecordProperty("at_rim", std::to_string(sum.at_rim));
    ::testing::Test::RecordProperty("differ", std::to_string(sum.differ));
}

/// Nodes anywhere in a box near the origin, supports from nearly none to half of it.
Case cloud_in_box(int dim, Random& random) {
    Case c;
    c.dim = dim;
    double shortest = 2;
    const int mask = 1 + random.below((1 << dim) - 1);
    for (int d = 0; d < dim; ++d) {
        const auto axis = static_cast<std::size_t>(d);
        c.domain.periodic[axis] = (mask >> d & 1) != 0;
        c.domain.lo[axis] = random.uniform(-1, 1);
        c.domain.hi[axis] = c.domain.lo[axis] + random.uniform(0.5, 2);
        if (c.domain.periodic[axis]) shortest = std::min(shortest, c.domain.length(d));
    }
    c.lists.resize(static_cast<std::size_t>(1 + random.below(3)));
    for (ListData& list : c.lists) list.extent = random.pick({1.0, 2.0, 3.0});
    const double K = c.kernel_extent();
    for (ListData& list : c.lists) {
        list.tensor = random.chance(0.5);
        const int n = 1 + random.below(40);
        for (int k = 0; k < n; ++k) {
            for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d)
                list.x.push_back(random.uniform(c.domain.lo[d], c.domain.hi[d]));
            const double h =
                (random.chance(0.1) ? 0.499 : random.uniform(0.02, 0.25)) * shortest / K;
            if (!list.tensor) {
                list.h.push_back(random.chance(0.05) ? 0.0 : h);
                continue;
            }
            double packed[6];
            const double axes[3] = {h, h * random.uniform(0.1, 1), h * random.uniform(0.1, 1)};
            rotated_tensor(dim, axes, random, packed);
            list.H.insert(list.H.end(), packed, packed + n_symmetric(dim));
        }
        list.n_internal = n;
    }
    return c;
}

TEST(GhostImages, of_any_cloud_give_the_neighbours_of_the_periodic_map) {
    Compared sum;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        Random random(seed + 4000);
        const Case c = cloud_in_box(1 + static_cast<int>(seed % 3), random);
        const Compared one = compare(c, false, SearchMethod::automatic);
        ASSERT_EQ(one.wrong, 0) << "seed " << seed;
        sum += one;
    }
    EXPECT_GT(sum.entries, 200000);
    EXPECT_LE(sum.at_rim, sum.entries / 100000);
    EXPECT_LE(sum.differ, sum.entries / 100000);
    record(sum);
}

/// Lattices, nodes at the rim itself, offsets, needles, units of any size: here shifted positions
/// do lose bits.
TEST(GhostImages, of_hard_cases_differ_only_at_the_rim_and_rarely) {
    Compared sum;
    for (std::uint64_t seed = 0; seed < 900; ++seed) {
        Case c = random_case(seed, {1 + static_cast<int>(seed % 3), true, 100});
        c.ghost_rows = false;
        c.mode = SearchMode::gather_scatter;
        move_inside(c);
        const Compared one = compare(c, true, SearchMethod::automatic);
        ASSERT_EQ(one.wrong, 0) << c.text;
        sum += one;
    }
    EXPECT_GT(sum.entries, 100000);
    EXPECT_GT(sum.at_rim, 100) << "no node stands where rounding could decide";
    EXPECT_LE(sum.at_rim, sum.entries / 5);
    EXPECT_LE(sum.differ, sum.entries / 100);
    record(sum);
}

/// A lattice whose numbers are exact: no shift loses a bit, and all agree, rim or not.
TEST(GhostImages, of_an_exact_lattice_give_the_very_same_neighbours) {
    for (int dim = 1; dim <= 3; ++dim)
        for (const double radius : {1.0, 1.5, 2.0, 3.0}) {
            const int n = dim == 1 ? 8 : dim == 2 ? 64 : 512;
            std::vector<double> x;
            for (int k = 0; k < n; ++k)
                for (int d = 0; d < dim; ++d) x.push_back((k >> 3 * d) % 8);
            Case c = uniform_case(dim, std::move(x), radius, 1);
            for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d)
                c.domain.periodic[d] = true, c.domain.hi[d] = 8;
            const Compared one = compare(c, false, SearchMethod::automatic);
            EXPECT_EQ(one.wrong + one.differ, 0) << dim << ", " << radius;
            EXPECT_EQ(one.at_rim > 0, radius != 1.5) << dim << ", " << radius;
        }
}

}  // namespace
}  // namespace connectivity::test
