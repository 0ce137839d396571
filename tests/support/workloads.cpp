// SPDX-License-Identifier: BSD-3-Clause
#include <support/workloads.hpp>

#include <cmath>
#include <cstdlib>
#include <new>
#include <stdexcept>

#include <conformance/workloads.h>

namespace connectivity::test {
namespace {

/// 1 for "W1" and "W1@1e4"; 0 if there is none of that name.
int number_in(const std::string& name) {
    const std::string stem = name.substr(0, name.find('@'));
    const bool known =
        stem.size() == 2 && stem[0] == 'W' && stem[1] >= '1' && stem[1] <= '0' + CONF_N_WORKLOADS;
    return known ? stem[1] - '0' : 0;
}

/// The size after the @ of a name, or the standard one.
Offset size_in(const std::string& name, Offset standard) {
    const std::size_t at = name.find('@');
    if (at == std::string::npos) return standard;
    const char* const text = name.c_str() + at + 1;
    char* end = nullptr;
    const double n = std::strtod(text, &end);
    if (end == text || *end != 0 || !(n >= 1 && n <= 1e8))
        throw std::invalid_argument("size of workload " + name + ": a number of 1 to 1e8");
    return std::llround(n);
}

}  // namespace

Workload make_workload(const std::string& name) {
    const int number = number_in(name);
    if (number == 0)
        throw std::invalid_argument("no workload named " + name + "; known: W1 ... W7, W1@1e4");
    const conf_workload_facts known = conf_workload_known(number);
    const Offset n = size_in(name, known.n);
    conf_workload made;
    if (conf_workload_make(number, n, &made) != 0) throw std::bad_alloc();
    Workload w;
    w.name = name;
    w.dim = made.dim;
    w.n = made.n;
    w.constant_R = made.same_radius != 0;
    w.hash = made.hash;
    if (n == known.n) w.n_pairs = known.n_pairs, w.wanted_hash = known.hash;
    for (Offset p = 0; p < w.n; ++p) w.x.insert(w.x.end(), made.x + 3 * p, made.x + 3 * p + w.dim);
    w.R.assign(made.radius, made.radius + w.n);
    conf_workload_free(&made);
    return w;
}

}  // namespace connectivity::test
