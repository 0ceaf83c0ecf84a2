// A file in HDF5, written: groups, datasets that grow along their first dimension, attributes. A thin owner of the C
// library's identifiers, and the only part of nilas that includes its header (in the source, so that none of its macros
// leaves it).
//
// Errors: every function throws std::runtime_error, one line with the path of the file, the place in it, and the
// library's own innermost reason. HDF5's own printing is switched off.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nilas::cases {

/// Owns one HDF5 identifier and knows where it is, for error messages. Closed when it goes.
class Hdf5Object {
 public:
  Hdf5Object(Hdf5Object&& other) noexcept : id_(std::exchange(other.id_, -1)), where_(std::move(other.where_)) {}
  Hdf5Object& operator=(Hdf5Object&& other) noexcept;
  ~Hdf5Object();

  /// Makes an attribute, or gives the one of that name a new value of the same type and size. Text is fixed-length
  /// ASCII, as VTK expects it.
  void set_attribute(const std::string& name, std::string_view text);
  void set_attribute(const std::string& name, std::int64_t value);
  void set_attribute(const std::string& name, std::span<const std::int64_t> values);

 protected:
  Hdf5Object(std::int64_t id, std::string where) : id_(id), where_(std::move(where)) {}
  std::int64_t id() const { return id_; }
  const std::string& where() const { return where_; }

 private:
  std::int64_t id_;
  std::string where_;  // file:/group/name
};

/// T of a dataset: float, double or std::int64_t; stored little-endian in the same width.
class Hdf5Dataset : public Hdf5Object {
 public:
  /// Appends whole rows along the first dimension; `values` row by row, a multiple of a row's values.
  template <class T>
  void append(std::span<const T> values);

 private:
  friend class Hdf5Group;
  using Hdf5Object::Hdf5Object;
};

class Hdf5Group : public Hdf5Object {
 public:
  /// Makes a new group inside this one.
  Hdf5Group make_group(const std::string& name);

  /// Writes a dataset that stays as it is. `shape`: rows first; its product is the number of values, which may be zero.
  template <class T>
  void write(const std::string& name, const std::vector<std::size_t>& shape, std::span<const T> values);

  /// Makes an empty dataset of rows of the given shape ({} for one value, {3} for a vector), stored `rows_per_chunk`
  /// rows at a time: as many as are usually appended or read together.
  template <class T>
  Hdf5Dataset make_growing(const std::string& name, const std::vector<std::size_t>& row_shape,
                           std::size_t rows_per_chunk);

 protected:
  using Hdf5Object::Hdf5Object;
};

/// A new file, replacing one of that name; itself the root group. It takes no lock: other programs may read the file
/// while it is being written, and see it whole as of the last flush.
class Hdf5File : public Hdf5Group {
 public:
  explicit Hdf5File(const std::filesystem::path& path);
  /// Hands everything to the operating system: the file is complete even if the process is killed afterwards.
  void flush();
};

}  // namespace nilas::cases
