// What a run writes: particle frames and body histories (result.h5 with result.xmf), history.csv. The only place that
// knows HDF5. SI units, world frame unless a name ends in _body.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "rigid/state.hpp"
#include "sph/vector.hpp"

namespace nilas::cases {

/// A named per-particle quantity of a frame; `components` values per particle, particle by particle.
struct Field {
  std::string name;  // with unit: "pressure_Pa"
  int components;    // 1 or 3
  std::vector<float> values;
};

/// The ice at one time. Particles are in the order of creation, the same in every frame.
struct IceFrame {
  double time;                 // s
  std::vector<Vec3> position;  // m
  std::vector<Field> fields;   // the same names in every frame
};

/// What never changes about a body.
struct BodyDescription {
  std::string name;
  std::string shape;
  std::vector<Vec3> boundary_position_body;  // m
  std::vector<Vec3> boundary_normal_body;
  std::vector<double> boundary_area;  // m2
  std::vector<Vec3> outline_body;     // m, closed polyline in the body's y-z plane
};

/// A body at the time of a frame.
struct BodyFrame {
  rigid::State state;
  Vec3 velocity;               // m/s
  Vec3 angular_velocity;       // rad/s
  std::vector<Vec3> traction;  // Pa, on each boundary particle, mean since the previous frame (zero in the first)
  std::vector<Vec3> impulse;   // N s, on each boundary particle since the start
};

/// Writes result.h5 and result.xmf into an existing directory, frame by frame; both files are complete and readable
/// after every `append` (a run that is interrupted or fails leaves what it had).
///
/// result.h5: /VTKHDF is a temporal PolyData of VTKHDF 2.0 (Points float64, PointData float32); /bodies/<name>/ holds
/// time, position, orientation_wxyz, velocity, angular_velocity (one row per frame), traction_Pa and impulse_N_s
/// (frame, particle, xyz), boundary/{position_body, normal_body, area_m2} and outline_body.
/// result.xmf: XDMF 2 over the same arrays, which ParaView 5.11 opens.
///
/// Errors: std::runtime_error with the path if a file cannot be written. A non-finite value is an error, never written.
class ResultWriter {
 public:
  ResultWriter(const std::filesystem::path& directory, const std::vector<BodyDescription>& bodies);
  ~ResultWriter();
  ResultWriter(const ResultWriter&) = delete;
  ResultWriter& operator=(const ResultWriter&) = delete;
  /// bodies: one per description, in that order.
  void append(const IceFrame& ice, const std::vector<BodyFrame>& bodies);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// history.csv: a header with units, one row per recorded step, flushed as it grows.
/// Errors as above; a non-finite value is an error, never written.
class HistoryWriter {
 public:
  HistoryWriter(const std::filesystem::path& file, const std::vector<std::string>& columns);
  ~HistoryWriter();
  /// One value per column, in order; written with 17 significant digits where needed to read back exactly.
  void append(const std::vector<double>& row);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nilas::cases
