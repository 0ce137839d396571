// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <connectivity/base/runtime.hpp>
#include <connectivity/io/node_file.hpp>

#include "program/cloud.hpp"
#include "program/commands.hpp"
#include "program/console.hpp"

namespace connectivity::program {

void run_cloud(const CloudOptions& options) {
    start_runtime({.n_threads = options.n_threads});
    Console console(2);
    std::optional<ListData> cloud;
    console.phase("drawing nodes", [&] { cloud.emplace(make_cloud(options.n, options.seed)); });
    console.phase("writing", [&] {
        write_node_file(options.out, {&*cloud, 1}, cloud_domain(), options.command);
    });
    Console::line(fmt::format("wrote {}: {} nodes in the periodic unit box, seed {}", options.out,
                              options.n, options.seed));
}

}  // namespace connectivity::program
