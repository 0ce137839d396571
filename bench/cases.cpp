// SPDX-License-Identifier: BSD-3-Clause
#include "cases.hpp"

#include <algorithm>
#include <regex>

#include "contestants.hpp"
#include "host_step.hpp"
#include "pair_sums.hpp"
#include "peers/peer.hpp"
#include "yardstick.hpp"

namespace connectivity::bench {
namespace {

using Names = std::vector<std::string>;

/// What a variant is about, it measures in one form only.
bool fits(const std::string& variant, const std::string& form) {
    if (is_feature(variant)) return form == "both";
    return form == "pairs" || !(is_host_step(variant) || is_pair_sum(variant));
}

/// Adds a group for both numbers of threads: all contestants, then variants of ours.
void add(std::vector<CaseName>& cases, CaseName c, const Names& forms, const Names& variants) {
    Names whos = {"ours"};
    for (const Peer& peer : peers()) whos.push_back(peer.name);
    const bool plain = c.size.empty() && c.workload[0] == 'W';
    if (plain && yardstick_is_set()) whos.emplace_back("yardstick");
    for (const std::string& form : forms)
        for (const char* threads : {"1", "2"}) {
            c.form = form, c.threads = threads, c.variant.clear();
            for (const std::string& who : whos) {
                c.who = who;
                const Peer* const peer = peer_named(who);
                if (peer == nullptr || peer->takes_part(c)) cases.push_back(c);
            }
            c.who = "ours";
            for (const std::string& variant : variants) {
                c.variant = variant;
                if (fits(variant, form)) cases.push_back(c);
            }
        }
}

CaseName named(const std::string& workload, const std::string& size = "", bool first = false) {
    CaseName c;
    c.workload = workload, c.size = size, c.first = first;
    return c;
}

const Names all_forms = {"rows", "pairs", "both"};
const Names methods = {"brute", "cells", "groups"};
const Names skins = {"skin0", "skin0.05", "skin0.1", "skin0.2", "skin0.3", "skin0.5"};

void add_sizes(std::vector<CaseName>& cases, const std::string& workload) {
    for (const std::string size : {"1e3", "1e4", "3e4", "1e5", "3e5", "1e6", "4e6"}) {
        if (size == (workload == "W2" ? "1e5" : "1e6")) continue;  // the standard size
        Names variants;
        if (size == "1e3" || size == "1e4") {
            variants = methods;
            if (workload == "W1" || workload == "W3")
                variants.insert(variants.end(),
                                {"3lists", "tensor", "step", "reordered", "sumatomic", "sumrows",
                                 "sumcolours", "key", "overlap", "intersection"});
        }
        if ((workload == "W1" || workload == "W3" || workload == "W7") &&
            (size == "1e3" || size == "1e4" || size == "1e5"))
            variants.insert(variants.end(), skins.begin(), skins.end());
        add(cases, named(workload, size), all_forms, variants);
    }
}

std::string joined(const Names& words) {
    std::string text;
    for (const std::string& word : words)
        if (!word.empty()) text += (text.empty() ? "/" : "-") + word;
    return text;
}

}  // namespace

std::string CaseName::group() const {
    return workload + "/" + form + "/" + threads + joined({size, first ? "first" : ""});
}

std::string CaseName::name() const {
    return who + "/" + workload + "/" + form + "/" + threads +
           joined({size, first ? "first" : "", variant});
}

std::vector<CaseName> all_cases() {
    std::vector<CaseName> cases;
    for (const std::string workload : test::all_workloads)
        add(cases, named(workload), all_forms,
            workload == "W1" || workload == "W3"
                ? Names{"3lists", "tensor", "device", "step", "reordered", "sumatomic", "sumrows",
                        "sumcolours", "key", "overlap", "intersection"}
            : workload == "W7" ? Names{"device", "step", "reordered"}
                               : Names{"step", "reordered"});
    for (const std::string workload : test::all_workloads)
        add(cases, named(workload, "", true), all_forms, {});
    for (const std::string workload : test::all_workloads) add_sizes(cases, workload);
    for (const std::string size : {"1", "10", "100"})
        add(cases, named("W1", size), {"rows"}, methods);
    for (const std::string scene : hard_scenes)  // 1e5 nodes take brute and cells minutes in A16
        add(cases, named(scene), {"rows", "pairs"},
            scene.rfind("A16", 0) == 0 ? Names{"groups"} : methods);
    return cases;
}

std::vector<CaseName> selected_cases(const std::string& filter) {
    const bool inverted = filter[0] == '-';
    const std::regex pattern(inverted ? filter.substr(1) : filter, std::regex::extended);
    std::vector<CaseName> cases = all_cases();
    std::erase_if(
        cases, [&](const CaseName& c) { return std::regex_search(c.name(), pattern) == inverted; });
    return cases;
}

}  // namespace connectivity::bench
