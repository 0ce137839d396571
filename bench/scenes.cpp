// SPDX-License-Identifier: BSD-3-Clause
#include "scenes.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <support/random.hpp>

namespace connectivity::bench {
namespace {

using test::Random;

/// A random unit vector of two or three components; the third is 0 in the plane.
void random_direction(Random& random, int dim, double (&u)[3]) {
    const double cosine = dim == 3 ? random.uniform(-1, 1) : 0;
    const double sine = std::sqrt(1 - cosine * cosine);
    const double phi = random.uniform(0, 2 * std::numbers::pi);
    u[0] = sine * std::cos(phi), u[1] = sine * std::sin(phi), u[2] = cosine;
}

/// H of a body of revolution: half axis `along` in a random direction, `across` in all others.
void push_spheroid(Random& random, int dim, double along, double across, std::vector<double>& H) {
    double u[3];
    random_direction(random, dim, u);
    for (int a = 0; a < dim; ++a)
        for (int b = a; b < dim; ++b)
            H.push_back((a == b ? 1 / across : 0) + (1 / along - 1 / across) * u[a] * u[b]);
}

void push(Cloud& c, double x, double y, double z, double R) {
    c.x.insert(c.x.end(), {x, y, z});
    c.R.push_back(R);
}

void push_uniform(Cloud& c, Offset n, double size, double R, std::uint64_t seed) {
    Random random(seed);
    for (Offset k = 0; k < n; ++k) {
        const double x = random.uniform(0, size), y = random.uniform(0, size);
        push(c, x, y, random.uniform(0, size), R);
    }
}

void push_lattice(Cloud& c, int side, double spacing, double origin, double R) {
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
            for (int k = 0; k < side; ++k)
                push(c, origin + i * spacing, origin + j * spacing, origin + k * spacing, R);
}

Cloud coincident() {
    Cloud c;
    c.moves = false;
    for (int k = 0; k < 4096; ++k) push(c, 0.3, 0.3, 0.3, 0.1);
    return c;
}

Cloud tilted_plane() {
    Cloud c;
    Random random(2002);
    for (int k = 0; k < 10000; ++k) {
        const double across = random.uniform(0, 100) * std::sqrt(0.5);
        push(c, random.uniform(0, 100), across, across, std::sqrt(26 / std::numbers::pi));
    }
    return c;
}

/// 2000 nodes that all see their own cluster.
Cloud clusters(double width) {
    Cloud c;
    c.moves = false;
    Random random(2003);
    for (int k = 0; k < 2000; ++k) {
        const double x = random.uniform(0, width) + (k % 2), y = random.uniform(0, width);
        push(c, x, y, random.uniform(0, width), 0.1);
    }
    return c;
}

Cloud outlier(bool present) {
    Cloud c;
    push_uniform(c, 8000, 20, 2.4420079599615385, 2004);
    if (present) push(c, 1e30, 1e30, 1e30, 2.4420079599615385);
    return c;
}

Cloud pancakes() {
    Cloud c;
    push_uniform(c, 2000, 1, 0.25, 2008);
    Random random(3008);
    for (Offset k = 0; k < 2000; ++k) push_spheroid(random, 3, 5e-5, 50, c.H);
    return c;
}

Cloud on_the_boundary() {
    Cloud c;
    c.moves = false;
    push_lattice(c, 20, 0.125, 0, 0.25);
    return c;
}

Cloud far_from_the_origin() {
    Cloud c;
    push_lattice(c, 20, 0.01, 1e5, 0.024);
    return c;
}

Cloud giant(bool present) {
    Cloud c;
    push_uniform(c, 100000, 46, 2.4420079599615385, 2016);
    if (present) push(c, 23, 23, 23, 46);
    return c;
}

Cloud make_scene(const std::string& name) {
    if (name == "A1") return coincident();
    if (name == "A2") return tilted_plane();
    if (name == "A3") return clusters(1e-9);
    if (name == "A3base") return clusters(1e-3);
    if (name == "A4") return outlier(true);
    if (name == "A4base") return outlier(false);
    if (name == "A8") return pancakes();
    if (name == "A10") return on_the_boundary();
    if (name == "A14") return far_from_the_origin();
    if (name == "A16") return giant(true);
    if (name == "A16base") return giant(false);
    throw std::invalid_argument("no scene named " + name);
}

}  // namespace

Cloud make_cloud(const std::string& name) {
    if (name.rfind('A', 0) != 0) return {test::make_workload(name), {}, true};
    Cloud c = make_scene(name);
    c.name = name;
    c.n = static_cast<Offset>(c.R.size());
    c.constant_R = name != "A16";
    return c;
}

std::vector<double> stretched(const test::Workload& w) {
    Random random(41);
    const double root =
        std::pow(2.0, 1.0 / w.dim);  // volume kept: along * across^(dim - 1) = R^dim
    std::vector<double> H;
    for (const double R : w.R) push_spheroid(random, w.dim, 2 * R / root, R / root, H);
    return H;
}

std::vector<double> displaced(const test::Workload& w, int k) {
    Random random(1000 + static_cast<std::uint64_t>(k));
    std::vector<double> x = w.x;
    for (Offset p = 0; p < w.n; ++p) {
        double u[3];
        random_direction(random, w.dim, u);
        for (int d = 0; d < w.dim; ++d)
            x[static_cast<std::size_t>(p * w.dim + d)] +=
                0.05 * w.R[static_cast<std::size_t>(p)] * u[d];
    }
    return x;
}

}  // namespace connectivity::bench
