// The XDMF 2 sidecar of result.h5: the same arrays, described for readers that do not know temporal VTKHDF.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace nilas::cases {

/// A particle field of the file, /VTKHDF/PointData/<name>.
struct XdmfField {
  std::string name;
  int components;  // 1 or 3
};

/// XDMF 2 text over the particles of `hdf5_file` (a name relative to the sidecar): one grid of vertices per time, its
/// points and fields hyperslabs of /VTKHDF/Points (times x particles, 3) float64 and /VTKHDF/PointData float32.
/// Read by ParaView's "Xdmf Reader"; its Xdmf3 readers (5.11) show no points of a hyperslab.
std::string xdmf(const std::string& hdf5_file, const std::vector<double>& times, std::size_t particles,
                 const std::vector<XdmfField>& fields);

}  // namespace nilas::cases
