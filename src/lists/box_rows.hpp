// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A list of boxes with the image of every entry, where there are images: the library's CSR, and an
/// array beside its values that changes with it.
///
/// Invariants: those of Csr. A copy shares its storage, which a rebuild of either leaves to the
/// other.

#include <connectivity/base/csr.hpp>
#include <connectivity/lists/box_list.hpp>

namespace connectivity::detail {

class BoxRows {
public:
    /// Where fills write; `images` is null where there are none.
    struct Out {
        Offset* starts;
        BoxId* boxes;
        ImageCode* images;

        void put(Offset at, BoxId box, ImageCode image) const {
            boxes[at] = box;
            if (images != nullptr) images[at] = image;
        }
    };

    explicit BoxRows(const std::string& label)
        : label_(label), fill_label_(label + "/fill"), rows_(label) {}

    /// Of the loop that fills, which cannot fail and so must not make it.
    const std::string& fill_label() const { return fill_label_; }

    /// Length of row i is count(i). Returns bytes. Throws Error{memory}; nothing visible changes.
    template <class Count>
    Offset prepare(Offset n_rows, bool with_images, const Count& count) {
        return sized(rows_.prepare(n_rows, count), with_images);
    }
    Offset prepare_sizes(Offset n_rows, Offset n_values, bool with_images) {
        return sized(rows_.prepare_sizes(n_rows, n_values), with_images);
    }
    void reserve() {
        rows_.reserve();
        grown_ = {};
        const Offset n = n_images(), capacity = static_cast<Offset>(images_.size());
        if (n > capacity || images_.use_count() > 1)
            grown_ = allocate<ImageCode>(label_ + "/images", n + (capacity > 0 ? n / 16 : 0));
    }
    Out out() {
        View<ImageCode>& images = grown_.size() > 0 ? grown_ : images_;
        return {rows_.offsets_to_fill(), rows_.prepared_values(),
                with_images_ ? images.data() : nullptr};
    }
    Offset n_prepared() const { return rows_.n_prepared(); }
    void publish() {
        rows_.publish();
        if (grown_.size() > 0) images_ = grown_;
        grown_ = {};
        has_images_ = with_images_;
    }
    void clear() {
        rows_.clear();
        images_ = grown_ = {};
        has_images_ = false;
    }
    void abandon() {
        rows_.abandon();
        grown_ = {};
    }

    BoxList view() const {
        const auto n = static_cast<std::size_t>(has_images_ ? rows_.n_values() : 0);
        return {rows_.offsets(), rows_.values(),
                Kokkos::subview(images_, std::pair<std::size_t, std::size_t>(0, n))};
    }
    const Csr& rows() const { return rows_; }
    Offset bytes() const {
        return rows_.bytes() + static_cast<Offset>(images_.size() + grown_.size());
    }

private:
    Offset sized(Offset bytes, bool with_images) {
        with_images_ = with_images;
        return bytes + n_images();
    }
    Offset n_images() const { return with_images_ ? rows_.n_prepared() : 0; }

    std::string label_, fill_label_;
    Csr rows_;
    View<ImageCode> images_, grown_;                 // grown_ is empty when images_ can be reused
    bool with_images_ = false, has_images_ = false;  // prepared, published
};

}  // namespace connectivity::detail
