// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The ghost workflow: keeps copies of a host's node lists, makes ghosts behind them, boundary
/// after boundary, builds the map and drops the ghosts that nobody needs.
///
/// Invariants: lists() are the nodes of the last update, slots of the map are theirs; ghosts are a
/// contiguous tail of each list, block after block in the order of boundaries. Every ghost that an
/// internal node sees, or that sees an internal node, exists. A call that throws leaves ghosts and
/// map as they were. Cost: two copies of the nodes in memory (old and new), one pass over all nodes
/// for each plane; storage is kept from step to step.
///
/// A step of a host:   boundaries.move_inside(...);              nodes that left the domain
///                     boundaries.update(map, lists, ...);       ghosts, map, cull
///                     boundaries.fill_ghosts(...);              the host's own fields
/// between updates:    boundaries.refresh(lists);                nodes moved, lists stay

#include <memory>
#include <span>
#include <vector>

#include <connectivity/base/report.hpp>
#include <connectivity/boundary/boundary.hpp>
#include <connectivity/boundary/ghost_lists.hpp>
#include <connectivity/boundary/requirements.hpp>
#include <connectivity/map/connectivity_map.hpp>

namespace connectivity {

/// How a value behaves under a mirror.
enum class FieldKind {
    scalar,  ///< any number of components a node, copied
    vector,  ///< dim components
    tensor   ///< n_symmetric(dim) components, packed
};

/// A field of the host over the nodes of one list.
struct HostField {
    FieldKind kind = FieldKind::scalar;
    View<double> values;   ///< [n * n_components], host
    int n_components = 1;  ///< of a scalar; of no meaning for the others
};

struct GhostOptions {
    /// Where the map allows it: no rows of ghosts, nothing derived from them, and no skin, which a
    /// patch would end.
    bool cull = true;
    CullRule rule = CullRule::controls_as_made;
};

class Boundaries {
public:
    /// Throws Error{argument} unless dim is 1, 2 or 3.
    explicit Boundaries(int dim);
    ~Boundaries();
    Boundaries(Boundaries&&) noexcept;
    Boundaries& operator=(Boundaries&&) noexcept;

    /// Takes effect with the next update; returns its number. The order counts: later boundaries
    /// make ghosts of the ghosts of earlier ones. Throws Error{argument}: another dimension, a
    /// plane that is parallel to an earlier one and faces the same way, or faces it from outside.
    int add(Boundary boundary);

    int dim() const { return dim_; }
    int size() const { return static_cast<int>(boundaries_.size()); }
    const Boundary& operator[](int k) const { return boundaries_[static_cast<std::size_t>(k)]; }

    /// Drops all ghosts, makes them anew, rebuilds the map and culls. Ghosts in `lists` are
    /// ignored. With overlap ghosts reach two supports deep. Throws Error as `make` and
    /// ConnectivityMap::rebuild do; where only the cull fails, for memory, ghosts and map are those
    /// of this step, none culled.
    void update(ConnectivityMap& map, std::span<const NodeList> lists, const MapOptions& options,
                const GhostOptions& ghosts = {});

    /// The same with what packages asked for; report() then says who.
    void update(ConnectivityMap& map, std::span<const NodeList> lists,
                const Requirements& requirements, const MapOptions& base = {},
                const GhostOptions& ghosts = {});

    /// Ghosts alone, for hosts that rebuild by themselves with lists(), and cull() then. Throws
    /// Error: argument (no list, another dimension, a node outside the domain, controls that are no
    /// nodes), half_box (a support that reaches from plane to facing plane), nonfinite, memory.
    void make(std::span<const NodeList> lists, const MapOptions& options);

    /// Drops the ghosts that no internal node of the map needs, from the map and from here; returns
    /// how many. Pairwise fields of the caller keep the values of pairs that stay. Throws
    /// Error{stale} if the map's nodes are not lists(), Error{not_built} if the map has neither
    /// rows nor pairs, Error{argument} if it stores or uses rows of ghosts, Error{memory}.
    Offset cull(ConnectivityMap& map, CullRule rule = CullRule::controls_as_made,
                std::span<PairFieldBase* const> fields = {});

    /// Internal nodes moved, or their supports changed: takes them and makes the images of the same
    /// nodes anew, in place. Throws Error{argument} if sizes are not those of the last update.
    void refresh(std::span<const NodeList> lists);

    /// Drops all ghosts.
    void clear();

    /// Internal nodes and ghosts. Valid until the next call that is not const.
    const std::vector<NodeList>& lists() const;
    const GhostLists& ghosts() const;

    /// Number of the boundary that way `way` of ghosts() belongs to.
    int boundary_of(int way) const;

    /// How a ghost lies to the internal node that it finally comes from, through ghosts of ghosts:
    /// NodeList::owners() of lists(), and this map. Throws Error{argument} for a node that is no
    /// ghost.
    RigidMap image(int list, Offset ghost) const;

    /// Writes the ghosts' part of a field [n * n_components] of a list, from its internal part.
    /// Throws Error{argument} if the size disagrees.
    void fill_ghosts(int list, const HostField& field) const;

    /// The same for values of any type, copied: global ids, materials. values [n * n_components].
    template <class T>
    void copy_to_ghosts(int list, T* values, int n_components = 1) const {
        for (int way = 0; way < ghosts().n_ways(); ++way) {
            const GhostBlock& block = ghosts().block(way, list);
            for (Offset k = 0; k < block.n; ++k)
                for (int c = 0; c < n_components; ++c)
                    values[(block.first + k) * n_components + c] =
                        values[static_cast<Offset>(block.storage(k)) * n_components + c];
        }
    }

    /// Puts nodes that left the domain back: shifted across a periodic boundary, mirrored at a
    /// reflecting one, and what `fields` hold of them as well. positions [n * dim]. Returns how
    /// many nodes moved. Throws Error: nonfinite, argument (a node that the boundaries hand to and
    /// fro); the values before that node are then changed already.
    Offset move_inside(const View<double>& positions, std::span<const HostField> fields = {}) const;

    /// Ghosts made and culled, bytes, milliseconds; after an update with requirements also the
    /// map's products with who asked for them.
    const Report& report() const { return report_; }

private:
    struct State;

    double gap_to_facing_plane(const Plane& plane) const;
    void check_lists(const char* call, std::span<const NodeList> lists) const;
    void make_spare(std::span<const NodeList> lists, const MapOptions& options);
    void append_given(int boundary);
    template <int Dim>
    void append_way(int boundary, int way, const std::vector<Offset>& n_before,
                    const MapOptions& options);
    void publish(double ms);
    void report_cull(Offset removed, double ms);
    template <int Dim>
    Offset move_inside_in(const View<double>& positions, std::span<const HostField> fields) const;

    int dim_;
    std::vector<Boundary> boundaries_;
    std::unique_ptr<State> state_, spare_;
    View<double> scratch_;
    View<Slot> keep_, old2new_;
    Report report_;
};

}  // namespace connectivity
