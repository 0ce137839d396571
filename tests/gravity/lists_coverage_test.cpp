// SPDX-License-Identifier: BSD-3-Clause
// The walk's theorem by counting: each pair of particles is in one entry of one list, for every
// image, and (A, B) is in a symmetric list if (B, A) is.

#include <algorithm>
#include <set>

#include <gravity/tree_sum.hpp>
#include <support/gravity_solve.hpp>
#include <support/random.hpp>

namespace connectivity::test {
namespace {

using namespace detail;

struct ListCase {
    GravityScene scene;
    FarChoice choice;
    WalkRule rule;
    std::int32_t leaf = 4;
    bool periodic = false;
};

/// The tree of a case with its lists.
class Walked {
public:
    explicit Walked(const ListCase& c) {
        start_runtime();
        const SceneArrays<> arrays(c.scene);
        GravityOptions options;
        if (c.periodic) {
            options.domain = periodic_box();
            for (const Shift& shift : image_shifts(1, 1))
                if (shift != Shift{})
                    images_.shift.insert(images_.shift.end(), &shift[0], &shift[3]);
            images_.n = 27;
        }
        make_frame(arrays.particles(), options, frame_);
        tree_.plant(frame_, c.leaf, images_);
        cells_ = tree_.cells();
        make_rho(tree_.bodies(), far_degree(c.choice.form, c.choice.order), cells_);
        FarChoice choice = c.choice;
        weakest_.assign(static_cast<std::size_t>(cells_.n), 2.0);
        choice.weakest = weakest_.data();
        rebuild(c, choice);
    }
    void rebuild(const ListCase& c, const FarChoice& choice) {
        FarTest test;
        test.set(cells_, choice);
        lists_.build(cells_, test, c.rule, images_);
    }
    const Cells& cells() const { return cells_; }
    const CellLists& lists() const { return lists_; }
    const Images& images() const { return images_; }

private:
    Frame frame_;
    TreeSum tree_;
    Cells cells_;
    Images images_;
    std::vector<double> weakest_;
    CellLists lists_;
};

template <class Visit>
void for_each_entry(const Csr& csr, const Visit& visit) {
    for (CellId a = 0; a < csr.n_rows(); ++a)
        for (Offset e = csr.offset_data()[a]; e < csr.offset_data()[a + 1]; ++e)
            visit(a, Source::cell(csr.value_data()[e]), Source::image(csr.value_data()[e]));
}

void expect_each_pair_once(const Walked& walked) {
    const Cells& k = walked.cells();
    const int n_images = walked.images().n;
    const auto n = static_cast<std::size_t>(k.count(0));
    std::vector<int> times(n * n * static_cast<std::size_t>(n_images));
    for (const Csr* const csr : {&walked.lists().far(), &walked.lists().near()})
        for_each_entry(*csr, [&](CellId a, CellId b, int image) {
            for (int i = k.first(a); i < k.first(a) + k.count(a); ++i)
                for (int j = k.first(b); j < k.first(b) + k.count(b); ++j)
                    ++times[(static_cast<std::size_t>(i) * n + static_cast<std::size_t>(j)) *
                                static_cast<std::size_t>(n_images) +
                            static_cast<std::size_t>(image)];
        });
    EXPECT_EQ(std::count(times.begin(), times.end(), 1), static_cast<long>(times.size()));
}

/// The image that is moved the other way.
int opposite(const Images& images, int image) {
    for (int k = 0; k < images.n; ++k) {
        bool is = true;
        for (int d = 0; d < 3; ++d)
            is = is && images.shift[3 * k + d] == -images.shift[3 * image + d];
        if (is) return k;
    }
    return -1;
}

void expect_symmetric(const Walked& walked) {
    for (const Csr* const csr : {&walked.lists().far(), &walked.lists().near()}) {
        std::set<std::array<int, 3>> entries;
        for_each_entry(*csr, [&](CellId a, CellId b, int image) { entries.insert({a, b, image}); });
        int n_alone = 0;
        for (const auto& [a, b, image] : entries)
            n_alone +=
                static_cast<int>(!entries.contains({b, a, opposite(walked.images(), image)}));
        EXPECT_EQ(n_alone, 0);
    }
}

ListCase random_case(std::uint64_t seed) {
    Random random(seed);
    ListCase c;
    c.periodic = random.chance(0.3);
    const char* const open[] = {"G1",    "G2", "G4", "G5", "G6", "cold_cube", "one_heavy_corner",
                                "spiral"};
    const char* const boxed[] = {"G2", "G5", "cold_cube"};
    c.scene = make_gravity_scene(c.periodic ? random.pick(boxed) : random.pick(open),
                                 1 + random.below(c.periodic ? 120 : 400));
    if (random.chance(0.3)) c.scene.e.assign(c.scene.x.size(), 1e-3);
    c.choice.form = random.chance(0.5) ? FarForm::cell_to_cell : FarForm::cell_to_particles;
    c.choice.acceptance = static_cast<Acceptance>(random.below(3));
    c.choice.order = 1 + random.below(12);
    c.choice.epsilon = c.choice.acceptance == Acceptance::geometric ? random.uniform(0.3, 0.95)
                                                                    : random.log_uniform(1e-4, 10);
    c.choice.symmetric = c.choice.form == FarForm::cell_to_cell && random.chance(0.7);
    c.rule.near_pairs = random.chance(0.5) ? 0 : random.uniform(0, 30);
    c.rule.group = 1 + random.below(20);
    c.leaf = 1 + random.below(8);
    return c;
}

TEST(CellLists, hold_each_pair_of_particles_once) {
    int n_far = 0, n_symmetric = 0;
    for (std::uint64_t seed = 0; seed < 150; ++seed) {
        SCOPED_TRACE(seed);
        const ListCase c = random_case(seed);
        const Walked walked(c);
        expect_each_pair_once(walked);
        n_far += walked.lists().far().n_values() > 0 ? 1 : 0;
        if (c.choice.symmetric) expect_symmetric(walked);
        n_symmetric += c.choice.symmetric ? 1 : 0;
    }
    EXPECT_GT(n_far, 75);
    EXPECT_GT(n_symmetric, 30);
}

TEST(CellLists, of_few_targets_are_rows_of_all) {
    for (std::uint64_t seed = 200; seed < 230; ++seed) {
        SCOPED_TRACE(seed);
        ListCase c = random_case(seed);
        c.choice.acceptance = Acceptance::field;
        Walked walked(c);
        const auto copy = [&](CellId cell) {
            std::vector<Slot> row;
            for (const Csr* const csr : {&walked.lists().far(), &walked.lists().near()}) {
                row.insert(row.end(), csr->value_data() + csr->offset_data()[cell],
                           csr->value_data() + csr->offset_data()[cell + 1]);
                row.push_back(-1);
            }
            return row;
        };
        std::vector<std::vector<Slot>> all;
        for (CellId cell = 0; cell < walked.cells().n; ++cell) all.push_back(copy(cell));
        CellSet set;
        take_paths(walked.cells(), {0}, set);
        c.rule.active = set.mask();
        walked.rebuild(c, c.choice);
        for (const CellId cell : set.ids)
            EXPECT_EQ(copy(cell), all[static_cast<std::size_t>(cell)]);
    }
}

}  // namespace
}  // namespace connectivity::test
