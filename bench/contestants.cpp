// SPDX-License-Identifier: BSD-3-Clause
#include "contestants.hpp"

#include <stdexcept>

#include <connectivity/base/runtime.hpp>
#include <connectivity/map/connectivity_map.hpp>

#if defined(CONNECTIVITY_BENCH_NANOFLANN)
#include "nanoflann_peer.hpp"
#endif

namespace connectivity::bench {
namespace {

class Ours final : public Contestant {
public:
    Ours(const test::Workload& w, Form form) {
        const auto view = [](const std::vector<double>& v) {
            return ConstView<double>(v.data(), v.size());
        };
        lists_.push_back(NodeList::with_h(w.name, w.dim, w.n, view(w.x), view(w.R), 1.0));
        options_.rows = form != Form::pairs;
        options_.pairs = form != Form::rows;
    }

    void build() override { map_.rebuild(lists_, options_); }
    Offset n_row_entries() const override { return options_.rows ? map_.rows().size() : 0; }
    Offset n_pairs() const override { return options_.pairs ? map_.pairs().size() : 0; }
    Offset result_bytes() const override {
        const auto bytes = [this](bool built, Offset n_values) {
            return built ? n_values * Offset{sizeof(Slot)} +
                               (map_.layout().n_slots() + 1) * Offset{sizeof(Offset)}
                         : 0;
        };
        return bytes(options_.rows, n_row_entries()) + bytes(options_.pairs, n_pairs());
    }

private:
    std::vector<NodeList> lists_;
    MapOptions options_;
    ConnectivityMap map_;
};

}  // namespace

Form form_of(const std::string& name) {
    if (name == "rows") return Form::rows;
    if (name == "pairs") return Form::pairs;
    if (name == "both") return Form::both;
    throw std::invalid_argument("no form named " + name);
}

std::vector<std::string> contestants() {
#if defined(CONNECTIVITY_BENCH_NANOFLANN)
    return {"ours", "nanoflann"};
#else
    return {"ours"};
#endif
}

std::unique_ptr<Contestant> make_contestant(const std::string& who, const test::Workload& workload,
                                            Form form) {
    start_runtime();
    if (who == "ours") return std::make_unique<Ours>(workload, form);
#if defined(CONNECTIVITY_BENCH_NANOFLANN)
    if (who == "nanoflann") return make_nanoflann(workload, form);
#endif
    throw std::invalid_argument("no contestant named " + who);
}

}  // namespace connectivity::bench
