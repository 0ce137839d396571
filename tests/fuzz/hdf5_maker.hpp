// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Well-formed HDF5 files from bytes: groups, datasets and attributes with the names that readers
/// look for, mostly as they should be, and any of them spoilt: another type, another shape, sizes
/// beyond all memory without data, values that are no numbers, links that lead nowhere.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <hdf5.h>

#include <support/random.hpp>

namespace connectivity::test {

using Extents = std::vector<hsize_t>;

class Hdf5Maker {
public:
    /// Writes one file; `bytes` decide on everything in it.
    Hdf5Maker(const std::string& path, Random& random);
    ~Hdf5Maker();
    Hdf5Maker(const Hdf5Maker&) = delete;
    Hdf5Maker& operator=(const Hdf5Maker&) = delete;

    void node_file();
    void gadget();
    void swift();
    void h5part();
    void lists_case();
    /// Something anywhere, under a name that means something or none.
    void anything();

private:
    struct Space {
        hid_t id;
        hsize_t n;  ///< values
        bool is_huge;
    };

    void attribute(const std::string& group, const std::string& name,
                   const std::vector<double>& values);
    void text(const std::string& group, const std::string& name, const std::string& value);
    void dataset(const std::string& name, const Extents& usual, bool is_whole = false);
    void particle_type(const std::string& name, const char* h, const char* density);
    void link(const std::string& name);
    void put_attribute(hid_t object, const std::string& name, hid_t type,
                       const std::vector<double>& values, bool is_scalar);

    bool spoilt(double probability);
    hid_t number_type();
    hid_t any_type();  ///< to be closed
    double value();
    Space space(const Extents& usual);
    hid_t creation(const Space& space, int rank);
    void fill(hid_t dataset, hid_t type, hsize_t n);
    hid_t open_group(const std::string& name);
    std::string any_name();

    Random& random_;
    hid_t file_ = -1, parents_ = -1;
    hsize_t n_ = 0;  ///< nodes of the lists that are as they should be
};

}  // namespace connectivity::test
