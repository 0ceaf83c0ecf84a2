// Reads datasets and attributes back through the HDF5 library itself, knowing nothing of nilas' writer.
#pragma once

#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>
#include <string>
#include <vector>

namespace nilas::test {

struct Array {
  std::vector<hsize_t> shape;
  std::vector<double> values;
};

class Hdf5Reading {
 public:
  explicit Hdf5Reading(const std::filesystem::path& path) : file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {
    if (file_ < 0) throw std::runtime_error("cannot open " + path.string());
  }
  Hdf5Reading(const Hdf5Reading&) = delete;
  ~Hdf5Reading() { H5Fclose(file_); }

  /// Float, double or integer dataset as doubles.
  Array array(const std::string& name) const {
    const hid_t dataset = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    if (dataset < 0) throw std::runtime_error("no dataset " + name);
    const hid_t space = H5Dget_space(dataset);
    Array array;
    array.shape.resize(H5Sget_simple_extent_ndims(space));
    H5Sget_simple_extent_dims(space, array.shape.data(), nullptr);
    array.values.resize(H5Sget_simple_extent_npoints(space));
    EXPECT_GE(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()), 0) << name;
    H5Sclose(space);
    H5Dclose(dataset);
    return array;
  }

  std::size_t bytes_per_value(const std::string& name) const {
    const hid_t dataset = H5Dopen2(file_, name.c_str(), H5P_DEFAULT), type = H5Dget_type(dataset);
    const std::size_t size = H5Tget_size(type);
    H5Tclose(type);
    H5Dclose(dataset);
    return size;
  }

  std::int64_t integer_attribute(const std::string& object, const std::string& name) const {
    std::int64_t value = -1;
    const hid_t attribute = H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Aread(attribute, H5T_NATIVE_INT64, &value), 0) << object << " " << name;
    H5Aclose(attribute);
    return value;
  }

  std::string text_attribute(const std::string& object, const std::string& name) const {
    const hid_t attribute = H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    const hid_t type = H5Aget_type(attribute);
    std::string text(H5Tget_size(type), '?');
    EXPECT_GE(H5Aread(attribute, type, text.data()), 0) << object << " " << name;
    H5Tclose(type);
    H5Aclose(attribute);
    return text;
  }

 private:
  hid_t file_;
};

}  // namespace nilas::test
