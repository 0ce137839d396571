// SPDX-License-Identifier: BSD-3-Clause
#include "hdf5_maker.hpp"

#include <algorithm>

namespace connectivity::test {

namespace {

constexpr hsize_t most_values = 4096;  // that are written

// clang-format off
const char* const words[] = {
    "PartType0", "PartType1", "PartType5", "Step#0", "Step#7", "Step#", "Step#9223372036854775807",
    "node_lists", "Header", "Config", "Parameters", "Code", "HydroScheme", "Units", "Cosmology",
    "Coordinates", "SmoothingLength", "SmoothingLengths", "Masses", "DynamicalMasses", "Density",
    "Densities", "ParticleIDs", "BoxSize", "MassTable", "NumPart_ThisFile", "NumPart_Total",
    "NumFilesPerSnapshot", "Dimension", "PERIODIC", "TWODIMS", "ONEDIMS", "LONG_X", "LONG_Y_BITS",
    "InitialConditions:periodic", "Kernel function", "UnitLength_in_cm", "UnitMass_in_g",
    "ComovingIntegrationOn", "Unit length in cgs (U_L)", "Cosmological run", "positions", "h", "H",
    "global_id", "mass", "softening", "n_internal", "order", "dim", "kernel_extent", "periodic",
    "box_lo", "box_hi", "x", "y", "z", "m", "rho", "id", "box", "boundaryType", "a", "b", "\xff",
    " ", "a name of some length that nobody looks for"};

const char* const groups[] = {
    "/", "PartType0", "PartType1", "Header", "Config", "Parameters", "Code", "HydroScheme",
    "Units", "Cosmology", "node_lists", "node_lists/a", "node_lists/b", "Step#0", "Step#7"};
// clang-format on

std::string join(const std::string& group, const std::string& name) {
    return group == "/" ? name : group + "/" + name;
}

}  // namespace

Hdf5Maker::Hdf5Maker(const std::string& path, Random& random)
    : random_(random), parents_(H5Pcreate(H5P_LINK_CREATE)) {
    H5Pset_create_intermediate_group(parents_, 1);
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fapl_core(access, 1 << 16, true);  // to the disk at once, when it is closed
    if (random_.chance(0.2)) H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
    file_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
    H5Pclose(access);
    n_ = static_cast<hsize_t>(random_.below(spoilt(0.1) ? 200 : 8));
}

Hdf5Maker::~Hdf5Maker() {
    H5Pclose(parents_);
    H5Fclose(file_);
}

/// False where the bytes have run out, so that what they do not reach is as it should be.
bool Hdf5Maker::spoilt(double probability) { return !random_.chance(1 - probability); }

std::string Hdf5Maker::any_name() { return words[random_.below(std::size(words))]; }

hid_t Hdf5Maker::open_group(const std::string& name) {
    if (name == "/") return H5Gopen2(file_, "/", H5P_DEFAULT);
    const hid_t made = H5Gcreate2(file_, name.c_str(), parents_, H5P_DEFAULT, H5P_DEFAULT);
    return made >= 0 ? made : H5Gopen2(file_, name.c_str(), H5P_DEFAULT);
}

hid_t Hdf5Maker::number_type() {
    const hid_t types[] = {H5T_IEEE_F64LE, H5T_IEEE_F32LE, H5T_IEEE_F64BE, H5T_STD_I8LE,
                           H5T_STD_U8LE,   H5T_STD_I16BE,  H5T_STD_I32LE,  H5T_STD_U32LE,
                           H5T_STD_I64LE,  H5T_STD_U64LE,  H5T_STD_U64BE,  H5T_NATIVE_LDOUBLE};
    return H5Tcopy(types[!spoilt(0.4) ? 0 : random_.below(std::size(types))]);
}

hid_t Hdf5Maker::any_type() {
    if (!spoilt(0.05)) return number_type();
    const hsize_t extent = 2;
    hid_t type = -1;
    switch (random_.below(9)) {
        case 0:
            type = H5Tcopy(H5T_C_S1);
            H5Tset_size(type, 1 + random_.below(40));
            break;
        case 1:
            type = H5Tcopy(H5T_C_S1);
            H5Tset_size(type, H5T_VARIABLE);
            break;
        case 2:
            type = H5Tcreate(H5T_COMPOUND, 16);
            H5Tinsert(type, "r", 0, H5T_NATIVE_DOUBLE);
            H5Tinsert(type, "i", 8, H5T_NATIVE_INT);
            break;
        case 3: {
            type = H5Tenum_create(H5T_NATIVE_INT8);
            std::int8_t no = 0, yes = 1;
            H5Tenum_insert(type, "FALSE", &no);
            H5Tenum_insert(type, "TRUE", &yes);
            break;
        }
        case 4: type = H5Tarray_create2(H5T_NATIVE_DOUBLE, 1, &extent); break;
        case 5: type = H5Tcreate(H5T_OPAQUE, 8); break;
        case 6: type = H5Tvlen_create(H5T_NATIVE_INT); break;
        case 7: type = H5Tcopy(H5T_STD_B64LE); break;
        default: type = H5Tcopy(H5T_STD_REF_OBJ); break;
    }
    return type;
}

double Hdf5Maker::value() {
    if (!spoilt(0.03)) return random_.uniform();
    return random_.pick({0.0, -0.0, -1.0, 1.0, 2.0, 3.0, 4.0, 1e18, 9223372036854775808.0, 1e300,
                         -1e300, 5e-324, std::numeric_limits<double>::infinity(), std::nan("")});
}

Hdf5Maker::Space Hdf5Maker::space(const Extents& usual) {
    Extents extents = usual;
    const auto any = [&] { return static_cast<std::size_t>(random_.below(4)); };
    bool is_huge = false;
    if (spoilt(0.06)) switch (random_.below(8)) {
            case 0: return {H5Screate(H5S_SCALAR), 1, false};
            case 1: return {H5Screate(H5S_NULL), 0, false};
            case 2: extents.assign(any() + 1, 1 + any()); break;
            case 3: extents[0] += any(); break;
            case 4: extents.back() = any(); break;
            case 5: extents.push_back(1 + any()); break;
            default: {
                const hsize_t sizes[] = {1ull << 20, 100000000,  1ull << 31, 3000000000,
                                         1ull << 40, 1ull << 60, 1ull << 61, 1ull << 62,
                                         1ull << 63, ~0ull >> 1, ~0ull - 1,  1000000000000000000};
                extents[0] = random_.pick(sizes);
                is_huge = true;
                if (random_.chance(0.3)) extents.back() = random_.pick(sizes);
            }
        }
    hsize_t n = 1;
    for (const hsize_t extent : extents) n = is_huge ? most_values + 1 : n * extent;
    const bool grows = random_.chance(0.1);
    const Extents unlimited(extents.size(), H5S_UNLIMITED);
    const int rank = static_cast<int>(extents.size());
    return {H5Screate_simple(rank, extents.data(), grows ? unlimited.data() : nullptr), n, is_huge};
}

/// Chunks where the extents may grow; else chunks, one block, or inside the header.
hid_t Hdf5Maker::creation(const Space& space, int rank) {
    const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
    std::array<hsize_t, H5S_MAX_RANK> extents{}, most{};
    H5Sget_simple_extent_dims(space.id, extents.data(), most.data());
    const bool must = rank > 0 && most[0] == H5S_UNLIMITED;
    if (rank > 0 && (must || random_.chance(0.25))) {
        std::array<hsize_t, H5S_MAX_RANK> chunk{};
        for (int d = 0; d < rank; ++d) {
            const auto k = static_cast<std::size_t>(d);
            chunk[k] = 1 + static_cast<hsize_t>(random_.below(8));
            if (!must) chunk[k] = std::max<hsize_t>(1, std::min(chunk[k], extents[k]));
        }
        H5Pset_chunk(list, rank, chunk.data());
        if (spoilt(0.1)) H5Pset_deflate(list, 1);
    } else if (!space.is_huge && random_.chance(0.2)) {
        H5Pset_layout(list, H5D_COMPACT);
    }
    H5Pset_alloc_time(list, space.is_huge ? H5D_ALLOC_TIME_LATE : H5D_ALLOC_TIME_DEFAULT);
    const double fill = 0.5;
    if (random_.chance(0.2)) H5Pset_fill_value(list, H5T_NATIVE_DOUBLE, &fill);
    return list;
}

/// Numbers are converted by HDF5; of other types the bytes do not matter, but pointers do.
void Hdf5Maker::fill(hid_t dataset, hid_t type, hsize_t n) {
    const H5T_class_t kind = H5Tget_class(type);
    if (kind == H5T_INTEGER || kind == H5T_FLOAT) {
        std::vector<double> values(n);
        for (double& v : values) v = value();
        H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    } else if (kind != H5T_VLEN && kind != H5T_REFERENCE && H5Tis_variable_str(type) <= 0) {
        const std::vector<char> bytes(n * H5Tget_size(type), 'x');
        H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
    }
}

void Hdf5Maker::dataset(const std::string& name, const Extents& usual, bool is_whole) {
    if (spoilt(0.02)) return;
    if (spoilt(0.02)) return link(name);
    const Space place = space(usual);
    const hid_t type = is_whole && !spoilt(0.1) ? H5Tcopy(H5T_STD_I64LE) : any_type(),
                list = creation(place, H5Sget_simple_extent_ndims(place.id));
    const hid_t data = H5Dcreate2(file_, name.c_str(), type, place.id, parents_, list, H5P_DEFAULT);
    if (data >= 0) {
        if (place.n > 0 && place.n <= most_values && !spoilt(0.01)) fill(data, type, place.n);
        H5Dclose(data);
    }
    H5Pclose(list);
    H5Tclose(type);
    H5Sclose(place.id);
}

void Hdf5Maker::put_attribute(hid_t object, const std::string& name, hid_t type,
                              const std::vector<double>& values, bool is_scalar) {
    const hsize_t n = values.size();
    const hid_t space = is_scalar ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &n, nullptr);
    const hid_t at = H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT);
    const H5T_class_t kind = H5Tget_class(type);
    if (at >= 0 && n > 0) {
        if (kind == H5T_INTEGER || kind == H5T_FLOAT)
            H5Awrite(at, H5T_NATIVE_DOUBLE, values.data());
        else if (kind == H5T_ENUM || kind == H5T_COMPOUND || kind == H5T_OPAQUE)
            H5Awrite(at, type, std::vector<char>(n * H5Tget_size(type), 1).data());
    }
    if (at >= 0) H5Aclose(at);
    H5Sclose(space);
}

void Hdf5Maker::attribute(const std::string& group, const std::string& name,
                          const std::vector<double>& values) {
    if (spoilt(0.03)) return;
    const hid_t object = open_group(group);
    if (object < 0) return;
    std::vector<double> written = values;
    bool is_scalar = values.size() == 1 && random_.chance(0.7);
    if (spoilt(0.08)) {
        for (double& v : written)
            if (spoilt(0.5)) v = random_.chance(0.5) ? value() : random_.below(9) - 2;
        if (spoilt(0.4)) {
            written.resize(static_cast<std::size_t>(random_.below(9)));
            is_scalar = false;
        }
    }
    const hid_t type = any_type();
    put_attribute(object, name, type, written, is_scalar);
    H5Tclose(type);
    H5Gclose(object);
}

void Hdf5Maker::text(const std::string& group, const std::string& name, const std::string& value) {
    const hid_t object = open_group(group);
    if (object < 0) return;
    std::string written = value;
    if (spoilt(0.1)) written.resize(static_cast<std::size_t>(random_.below(80)), ' ');
    if (spoilt(0.1)) written += '\0';
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    const bool varies = random_.chance(0.4);
    H5Tset_size(type, varies ? H5T_VARIABLE : std::max<std::size_t>(1, written.size()));
    if (random_.chance(0.3)) H5Tset_strpad(type, H5T_STR_SPACEPAD);
    const hid_t at = H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT);
    const char* const data = written.c_str();
    if (at >= 0 && !spoilt(0.03))
        H5Awrite(at, type, varies ? static_cast<const void*>(&data) : data);
    if (at >= 0) H5Aclose(at);
    H5Sclose(space);
    H5Tclose(type);
    H5Gclose(object);
}

void Hdf5Maker::link(const std::string& name) {
    const std::string other = any_name();
    switch (random_.below(4)) {
        case 0: H5Lcreate_soft(other.c_str(), file_, name.c_str(), parents_, H5P_DEFAULT); return;
        case 1: H5Lcreate_hard(file_, "/", file_, name.c_str(), parents_, H5P_DEFAULT); return;
        case 2:
            H5Lcreate_external("missing.h5", other.c_str(), file_, name.c_str(), parents_,
                               H5P_DEFAULT);
            return;
        default: {
            const hid_t type = any_type();
            H5Tcommit2(file_, name.c_str(), type, parents_, H5P_DEFAULT, H5P_DEFAULT);
            H5Tclose(type);
        }
    }
}

void Hdf5Maker::anything() {
    const std::string group = groups[random_.below(std::size(groups))], name = any_name();
    Extents extents;
    for (int rank = random_.below(4); rank >= 0; --rank)
        extents.push_back(static_cast<hsize_t>(random_.below(6)));
    switch (random_.below(5)) {
        case 0: return attribute(group, name, {double(random_.below(5))});
        case 1: return text(group, name, any_name());
        case 2: return link(join(group, name));
        case 3:
            if (const hid_t made = open_group(join(group, name)); made >= 0) H5Gclose(made);
            return;
        default: return dataset(join(group, name), extents);
    }
}

}  // namespace connectivity::test
