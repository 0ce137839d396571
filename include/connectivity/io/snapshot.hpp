// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What a file of particles holds, and the interface that every reader of one implements.
///
/// A reader looks at the file once (`info`) and reads the arrays of a list only when asked. Sizes
/// are 64 bits, numbers of any precision become double. Shapes and formats are checked here; values
/// (finite positions, h >= 0, supports within half a periodic box) are checked by
/// ConnectivityMap::rebuild.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <connectivity/base/box.hpp>
#include <connectivity/map/node_list.hpp>

namespace connectivity {

/// Units of the numbers in a file; 0 where the file does not tell.
struct Units {
    double length_cm = 0;
    double mass_g = 0;
    bool per_h = false;     ///< lengths and masses are given in units of 1/h (h: Hubble parameter)
    bool comoving = false;  ///< lengths are comoving

    bool known() const { return length_cm > 0 && mass_g > 0; }
};

/// One list as the file's table of contents shows it.
struct ListInfo {
    std::string name;
    Offset n = 0, n_internal = 0;
    bool has_support =
        false;  ///< smoothing lengths or tensors; without them nodes take part with h = 0
    bool has_mass = false;
};

struct SnapshotInfo {
    std::string path;
    std::string format;  ///< "GADGET", "SWIFT", "H5Part", "node file"
    std::string detail;  ///< which step, which kernel; may be empty
    int dim = 3;
    Domain domain;
    Units units;
    std::vector<ListInfo> lists;  ///< in the order of the file
};

/// Arrays beyond positions and supports that a caller wants, where the file has them.
struct FieldRequest {
    bool mass = false, density = false, softening = false, global_id = false;
};

/// One list in memory. All arrays lie on the host; those not asked for or not in the file are
/// empty.
struct ListData {
    NodeList nodes;
    ConstView<double> mass = {};             ///< [n]
    ConstView<double> density = {};          ///< [n], as another code computed it
    ConstView<double> softening = {};        ///< [n]
    ConstView<std::int64_t> global_id = {};  ///< [n]
};

class SnapshotReader {
public:
    virtual ~SnapshotReader() = default;

    virtual const SnapshotInfo& info() const = 0;

    /// Throws Error: argument (no such list), format (a part is missing or has the wrong shape),
    /// file, memory.
    virtual ListData read(const std::string& list, const FieldRequest& fields) = 0;
};

struct ReadOptions {
    std::optional<double> kernel_extent;  ///< instead of what the format says, for all lists
    std::optional<Offset> step;           ///< H5Part: number of the step; the last unless told
    bool open = false;                    ///< no periodic axis, whatever the file says
};

/// Opens a GADGET, SWIFT, H5Part or node file, whichever it is. Starts the runtime if nobody did.
/// Throws Error: file (missing, unreadable, truncated), format (not HDF5, of no known format, parts
/// missing), argument (an option that the format does not have).
std::unique_ptr<SnapshotReader> open_snapshot(const std::string& path,
                                              const ReadOptions& options = {});

/// Lists in the order asked for; if none is named, every list that has supports. Throws Error:
/// argument (no such list, named twice), format (no list has supports).
std::vector<std::string> select_lists(const SnapshotInfo& info,
                                      const std::vector<std::string>& asked);

/// The same, but if none is named every list of the file, in its order.
std::vector<std::string> all_or_selected(const SnapshotInfo& info,
                                         const std::vector<std::string>& asked);

/// "HDF5 1.10.8" and the like.
std::string file_library();

}  // namespace connectivity
