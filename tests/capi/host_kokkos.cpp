// SPDX-License-Identifier: BSD-3-Clause
// A host with a static Kokkos of its own, beside the private one of the library, which it links or
// loads. Either may start first and either may end first; neither sees the other.
// Usage: host_kokkos host|library <path of libconnectivity.so>: who starts first.
// Exit status 0, or the number of the line that failed modulo 256.
#include <dlfcn.h>

#include <cstdlib>
#include <cstring>

#include <Kokkos_Core.hpp>

#include <connectivity.h>

#define REQUIRE(condition)                                                     \
    do {                                                                       \
        if (!(condition)) std::exit(__LINE__ % 256 == 0 ? 1 : __LINE__ % 256); \
    } while (0)

namespace {

#ifdef HOST_LINKS_THE_LIBRARY
#define FIND(name) name
#else
void* library = nullptr;
#define FIND(name) reinterpret_cast<decltype(&name)>(dlsym(library, #name))
#endif

constexpr int n = 50;

/// Sum of 0..999, from a View and two kernels of the host's Kokkos.
bool host_works() {
    const Kokkos::View<double*> values("values of the host", 1000);
    Kokkos::parallel_for(
        1000, KOKKOS_LAMBDA(const int k) { values(k) = k; });
    double sum = 0;
    Kokkos::parallel_reduce(
        1000, KOKKOS_LAMBDA(const int k, double& part) { part += values(k); }, sum);
    return sum == 999 * 500;
}

/// A chain of nodes with spacing 1 and supports of 1.5: each has pairs with its neighbours alone.
struct Chain {
    conn_context* context = nullptr;
    conn_nodes* nodes = nullptr;
    conn_map* map = nullptr;

    void start() {
        conn_context_options options = CONN_CONTEXT_OPTIONS_INIT;
        options.n_threads = 3;
        REQUIRE(FIND(conn_context_create)(&options, &context) == CONN_OK);
        REQUIRE(FIND(conn_nodes_create)(context, "chain", 1, 1.5, &nodes) == CONN_OK);
        REQUIRE(FIND(conn_map_create)(context, nullptr, &map) == CONN_OK);
    }
    bool works() const {
        double x[n], h[n];
        for (int a = 0; a < n; ++a) x[a] = a, h[a] = 1;
        const conn_array positions = conn_array_vector(x, n), lengths = conn_array_vector(h, n);
        conn_map_info info = CONN_MAP_INFO_INIT;
        std::int32_t n_threads = 0;
        return FIND(conn_nodes_set_h)(nodes, n, &positions, 1, &lengths) == CONN_OK &&
               FIND(conn_map_rebuild)(map, &nodes, 1) == CONN_OK &&
               FIND(conn_map_get_info)(map, &info) == CONN_OK && info.n_pairs == n - 1 &&
               FIND(conn_context_threads)(context, &n_threads) == CONN_OK && n_threads == 3;
    }
    void end() {
        REQUIRE(FIND(conn_map_destroy)(&map) == CONN_OK);
        REQUIRE(FIND(conn_nodes_destroy)(&nodes) == CONN_OK);
        REQUIRE(FIND(conn_context_destroy)(&context) == CONN_OK);
    }
};

/// The host ends its Kokkos, the library goes on.
void host_first(Chain& chain) {
    Kokkos::initialize();
    const int n_threads = Kokkos::DefaultHostExecutionSpace().concurrency();
    REQUIRE(host_works());
    chain.start();
    REQUIRE(chain.works() && host_works());
    REQUIRE(Kokkos::DefaultHostExecutionSpace().concurrency() == n_threads);
    Kokkos::finalize();
    REQUIRE(chain.works());
    chain.end();
}

/// The library ends its Kokkos, the host goes on.
void library_first(Chain& chain) {
    chain.start();
    REQUIRE(chain.works());
    REQUIRE(!Kokkos::is_initialized());
    Kokkos::initialize();
    REQUIRE(host_works() && chain.works());
    REQUIRE(FIND(conn_shutdown)() == CONN_OK);
    REQUIRE(Kokkos::is_initialized() && host_works());
    REQUIRE(FIND(conn_map_rebuild)(chain.map, &chain.nodes, 1) == CONN_E_FINALIZED);
    chain.end();
    REQUIRE(host_works());
    Kokkos::finalize();
}

}  // namespace

int main(int argc, char** argv) {
    REQUIRE(argc == 3);
#ifndef HOST_LINKS_THE_LIBRARY
    library = dlopen(argv[2], RTLD_NOW | RTLD_LOCAL);
    REQUIRE(library != nullptr);
#endif
    Chain chain;
    if (std::strcmp(argv[1], "host") == 0)
        host_first(chain);
    else
        library_first(chain);
    return 0;
}
