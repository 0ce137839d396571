// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Who takes part in the rebuild benchmark, and what each of them builds.
///
/// All contestants get the same points, in the same shuffled order, and deliver compressed sparse
/// rows by the caller's numbers: `rows` sorted, with both directions of every pair; `pairs` with
/// every pair once. Storage is kept from build to build by all of them.

#include <memory>
#include <string>
#include <vector>

#include <connectivity/base/types.hpp>

#include <support/workloads.hpp>

namespace connectivity::bench {

enum class Form { rows, pairs, both };

Form form_of(const std::string& name);  ///< "rows", "pairs" or "both"

class Contestant {
public:
    virtual ~Contestant() = default;
    virtual void build() = 0;
    virtual Offset n_row_entries() const = 0;  ///< of the last build, 0 if rows are not built
    virtual Offset n_pairs() const = 0;        ///< of the last build, 0 if pairs are not built
    virtual Offset result_bytes() const = 0;   ///< offsets and values of the lists delivered
};

/// "ours", and "nanoflann" where it was found.
std::vector<std::string> contestants();

/// The workload has to outlive the contestant. Starts the runtime.
std::unique_ptr<Contestant> make_contestant(const std::string& who, const test::Workload& workload,
                                            Form form);

}  // namespace connectivity::bench
