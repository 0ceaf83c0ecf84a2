#include "cases/hdf5_file.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cassert>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <type_traits>

namespace nilas::cases {
namespace {

static_assert(std::is_same_v<hid_t, std::int64_t>,
              "the header states identifiers as std::int64_t (HDF5 1.10 and later)");

// The innermost entry of the error stack is the one that says why ("No space left on device").
herr_t keep_innermost(unsigned n, const H5E_error2_t* error, void* reason) {
  if (n == 0 && error->desc != nullptr) *static_cast<std::string*>(reason) = error->desc;
  return 0;
}

[[noreturn]] void fail(const std::string& where, const std::string& what) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &reason);
  throw std::runtime_error(where + ": cannot " + what + (reason.empty() ? "" : ": " + reason));
}

/// The value if it is no error code.
template <class Id>
Id checked(Id value, const std::string& where, const std::string& what) {
  if (value < 0) fail(where, what);
  return value;
}

/// Identifiers that live for one function.
struct Scoped {
  hid_t id;
  explicit Scoped(hid_t id) : id(id) {}
  Scoped(const Scoped&) = delete;
  Scoped& operator=(const Scoped&) = delete;
  ~Scoped() {
    if (id >= 0) H5Idec_ref(id);
  }
  operator hid_t() const { return id; }
};

template <class T>
hid_t memory_type() {
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
}

template <class T>
hid_t file_type() {
  if constexpr (std::is_same_v<T, float>) return H5T_IEEE_F32LE;
  if constexpr (std::is_same_v<T, double>) return H5T_IEEE_F64LE;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_STD_I64LE;
}

std::vector<hsize_t> extent(std::size_t rows, const std::vector<std::size_t>& row_shape) {
  std::vector<hsize_t> all{rows};
  all.insert(all.end(), row_shape.begin(), row_shape.end());
  return all;
}

hsize_t product(const std::vector<hsize_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), hsize_t{1}, std::multiplies<>());
}

std::string below(const std::string& where, const std::string& name) {
  return where + (where.ends_with('/') ? "" : "/") + name;
}

hid_t open_new_file(const std::string& path) {
  // HDF5's own clean-up at exit crashes on a file that a full disk left open; ours closes what it opened. First call.
  H5dont_atexit();
  // Per thread and for good: this library reports errors by exceptions.
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Scoped access(H5Pcreate(H5P_FILE_ACCESS));
  // With a lock, nobody could look at the results while the run goes on, and a reader would stop the run.
  checked(H5Pset_file_locking(access, false, true), path, "switch off file locking");
  return checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), path, "create the file");
}

void write_attribute(hid_t object, const std::string& where, const std::string& name, hid_t type, hid_t space,
                     const void* data) {
  const htri_t exists = checked(H5Aexists(object, name.c_str()), where, "look up attribute " + name);
  const Scoped attribute(exists > 0 ? H5Aopen(object, name.c_str(), H5P_DEFAULT)
                                    : H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT));
  checked(attribute.id, where, "create attribute " + name);
  checked(H5Awrite(attribute, type, data), where, "write attribute " + name);
}

}  // namespace

Hdf5Object& Hdf5Object::operator=(Hdf5Object&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(where_, other.where_);
  return *this;
}

// Nothing to be done about a failure here: what was promised to be on disk was flushed before.
Hdf5Object::~Hdf5Object() {
  if (id_ >= 0) H5Idec_ref(id_);
}

void Hdf5Object::set_attribute(const std::string& name, std::string_view text) {
  const Scoped type(H5Tcopy(H5T_C_S1));
  checked(H5Tset_size(type, std::max<std::size_t>(text.size(), 1)), where_, "size attribute " + name);
  checked(H5Tset_strpad(type, H5T_STR_NULLPAD), where_, "pad attribute " + name);
  const Scoped space(H5Screate(H5S_SCALAR));
  write_attribute(id_, where_, name, type, space, text.empty() ? "" : text.data());
}

void Hdf5Object::set_attribute(const std::string& name, std::int64_t value) {
  const Scoped space(H5Screate(H5S_SCALAR));
  write_attribute(id_, where_, name, H5T_STD_I64LE, space, &value);
}

void Hdf5Object::set_attribute(const std::string& name, std::span<const std::int64_t> values) {
  const hsize_t size = values.size();
  const Scoped space(H5Screate_simple(1, &size, nullptr));
  write_attribute(id_, where_, name, H5T_STD_I64LE, space, values.data());
}

template <class T>
void Hdf5Dataset::append(std::span<const T> values) {
  hsize_t shape[H5S_MAX_RANK];
  const Scoped before(checked(H5Dget_space(id()), where(), "ask for the shape"));
  const int rank = checked(H5Sget_simple_extent_dims(before, shape, nullptr), where(), "ask for the shape");

  std::vector<hsize_t> start(rank, 0), count(shape, shape + rank);
  start[0] = shape[0];
  count[0] = 1;
  const hsize_t row = product(count);
  assert(row > 0 && values.size() % row == 0);
  count[0] = values.size() / row;
  shape[0] += count[0];

  checked(H5Dset_extent(id(), shape), where(), "extend the dataset");
  const Scoped target(checked(H5Dget_space(id()), where(), "ask for the shape"));
  checked(H5Sselect_hyperslab(target, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), where(),
          "select the new rows");
  const Scoped source(checked(H5Screate_simple(rank, count.data(), nullptr), where(), "describe the new rows"));
  checked(H5Dwrite(id(), memory_type<T>(), source, target, H5P_DEFAULT, values.data()), where(), "write");
}

Hdf5Group Hdf5Group::make_group(const std::string& name) {
  const std::string path = below(where(), name);
  const hid_t group = H5Gcreate2(id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  return Hdf5Group(checked(group, path, "create the group"), path);
}

template <class T>
void Hdf5Group::write(const std::string& name, const std::vector<std::size_t>& shape, std::span<const T> values) {
  const std::string path = below(where(), name);
  const std::vector<hsize_t> size(shape.begin(), shape.end());
  assert(product(size) == values.size());
  const Scoped space(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr));
  const Scoped dataset(H5Dcreate2(id(), name.c_str(), file_type<T>(), space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  checked(dataset.id, path, "create the dataset");
  if (values.empty()) return;
  checked(H5Dwrite(dataset, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path, "write");
}

template <class T>
Hdf5Dataset Hdf5Group::make_growing(const std::string& name, const std::vector<std::size_t>& row_shape,
                                    std::size_t rows_per_chunk) {
  const std::string path = below(where(), name);
  const std::vector<hsize_t> empty = extent(0, row_shape), chunk = extent(rows_per_chunk, row_shape);
  std::vector<hsize_t> limit = empty;
  limit[0] = H5S_UNLIMITED;
  const int rank = static_cast<int>(empty.size());
  const Scoped space(H5Screate_simple(rank, empty.data(), limit.data()));
  const Scoped layout(H5Pcreate(H5P_DATASET_CREATE));
  checked(H5Pset_chunk(layout, rank, chunk.data()), path, "choose the chunks");
  const hid_t dataset = H5Dcreate2(id(), name.c_str(), file_type<T>(), space, H5P_DEFAULT, layout, H5P_DEFAULT);
  return Hdf5Dataset(checked(dataset, path, "create the dataset"), path);
}

Hdf5File::Hdf5File(const std::filesystem::path& path) : Hdf5Group(open_new_file(path.string()), path.string() + ":/") {}

void Hdf5File::flush() { checked(H5Fflush(id(), H5F_SCOPE_GLOBAL), where(), "flush"); }

template void Hdf5Dataset::append(std::span<const float>);
template void Hdf5Dataset::append(std::span<const double>);
template void Hdf5Dataset::append(std::span<const std::int64_t>);
template void Hdf5Group::write(const std::string&, const std::vector<std::size_t>&, std::span<const float>);
template void Hdf5Group::write(const std::string&, const std::vector<std::size_t>&, std::span<const double>);
template void Hdf5Group::write(const std::string&, const std::vector<std::size_t>&, std::span<const std::int64_t>);
template Hdf5Dataset Hdf5Group::make_growing<float>(const std::string&, const std::vector<std::size_t>&, std::size_t);
template Hdf5Dataset Hdf5Group::make_growing<double>(const std::string&, const std::vector<std::size_t>&, std::size_t);
template Hdf5Dataset Hdf5Group::make_growing<std::int64_t>(const std::string&, const std::vector<std::size_t>&,
                                                           std::size_t);

}  // namespace nilas::cases
