// result.h5 and result.xmf. /VTKHDF follows the specification of VTKHDF 2.0, "Temporal Data": every array holds all
// times one after the other and /VTKHDF/Steps says where each time starts. What is constant (one part of N particles,
// each a vertex; no lines, polygons, strips) is written once and every step's offset into it is zero.
#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>

#include "cases/hdf5_file.hpp"
#include "cases/results.hpp"
#include "cases/xdmf.hpp"

namespace nilas::cases {
namespace {

using Shape = std::vector<std::size_t>;

constexpr std::size_t small_chunk = 256;  // rows of a dataset that grows by one small row per frame

std::span<const double> flat(const std::vector<Vec3>& vectors) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return {reinterpret_cast<const double*>(vectors.data()), 3 * vectors.size()};
}

std::span<const double> flat(const Vec3& vector) { return {vector.data(), 3}; }

template <class T>
std::span<const T> one(const T& value) {
  return {&value, 1};
}

std::array<double, 4> wxyz(const rigid::Quat& q) { return {q.w(), q.x(), q.y(), q.z()}; }

/// Throws if a value is not finite; `name` and the index are those under which it would stand in the file.
template <class T>
void require_finite(const std::filesystem::path& file, const std::string& name, std::span<const T> values,
                    std::size_t components) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    const std::string component = components > 1 ? fmt::format("[{}]", i % components) : "";
    throw std::runtime_error(fmt::format("{}: {}[{}]{} is {}: the frame is not written", file.string(), name,
                                         i / components, component, values[i]));
  }
}

/// The arrays below /VTKHDF that grow.
struct IceArrays {
  Hdf5Dataset points;
  std::vector<Hdf5Dataset> fields, field_offsets;
  Hdf5Dataset values, part_offsets, number_of_parts, point_offsets, cell_offsets, connectivity_id_offsets;
  Hdf5Group steps;
};

/// Cells of one kind, each a vertex: cell i is particle i.
void write_cells(Hdf5Group& root, const std::string& kind, std::size_t cells) {
  std::vector<std::int64_t> index(cells + 1);
  std::iota(index.begin(), index.end(), 0);
  Hdf5Group group = root.make_group(kind);
  group.write("NumberOfCells", {1}, one<std::int64_t>(cells));
  group.write("NumberOfConnectivityIds", {1}, one<std::int64_t>(cells));
  group.write("Offsets", {cells + 1}, std::span<const std::int64_t>(index));
  group.write("Connectivity", {cells}, std::span<const std::int64_t>(index).first(cells));
}

IceArrays make_ice(Hdf5File& file, const IceFrame& first) {
  const std::size_t particles = first.position.size();
  Hdf5Group root = file.make_group("VTKHDF");
  root.set_attribute("Version", std::array<std::int64_t, 2>{2, 0});
  root.set_attribute("Type", "PolyData");
  root.write("NumberOfPoints", {1}, one<std::int64_t>(particles));
  write_cells(root, "Vertices", particles);
  for (const char* none : {"Lines", "Polygons", "Strips"}) write_cells(root, none, 0);

  Hdf5Group point_data = root.make_group("PointData");
  Hdf5Group steps = root.make_group("Steps");
  steps.set_attribute("NSteps", std::int64_t{0});
  Hdf5Group offsets = steps.make_group("PointDataOffsets");
  std::vector<Hdf5Dataset> fields, field_offsets;
  for (const Field& field : first.fields) {
    const std::size_t components = field.components;
    fields.push_back(
        point_data.make_growing<float>(field.name, components == 1 ? Shape{} : Shape{components}, particles));
    field_offsets.push_back(offsets.make_growing<std::int64_t>(field.name, {}, small_chunk));
  }
  const auto per_step = [&steps](const char* name, const Shape& row) {
    return steps.make_growing<std::int64_t>(name, row, small_chunk);
  };
  return {.points = root.make_growing<double>("Points", {3}, particles),
          .fields = std::move(fields),
          .field_offsets = std::move(field_offsets),
          .values = steps.make_growing<double>("Values", {}, small_chunk),
          .part_offsets = per_step("PartOffsets", {}),
          .number_of_parts = per_step("NumberOfParts", {}),
          .point_offsets = per_step("PointOffsets", {}),
          .cell_offsets = per_step("CellOffsets", {4}),
          .connectivity_id_offsets = per_step("ConnectivityIdOffsets", {4}),
          .steps = std::move(steps)};
}

void append_ice(IceArrays& arrays, const IceFrame& frame, std::size_t step) {
  const std::int64_t start = step * frame.position.size();
  const std::array<std::int64_t, 4> from_the_start{};  // of vertices, lines, polygons, strips
  arrays.points.append(flat(frame.position));
  for (std::size_t i = 0; i < frame.fields.size(); ++i) {
    arrays.fields[i].append(std::span<const float>(frame.fields[i].values));
    arrays.field_offsets[i].append(one(start));
  }
  arrays.values.append(one(frame.time));
  arrays.part_offsets.append(one<std::int64_t>(0));
  arrays.number_of_parts.append(one<std::int64_t>(1));
  arrays.point_offsets.append(one(start));
  arrays.cell_offsets.append(std::span<const std::int64_t>(from_the_start));
  arrays.connectivity_id_offsets.append(std::span<const std::int64_t>(from_the_start));
}

/// The arrays below /bodies/<name> that grow.
struct BodyArrays {
  std::string path;  // bodies/<name>
  std::size_t boundary_particles;
  Hdf5Dataset time, position, orientation, velocity, angular_velocity, traction, impulse;
};

BodyArrays make_body(Hdf5Group& bodies, const BodyDescription& body) {
  const std::size_t count = body.boundary_position_body.size();
  assert(body.boundary_normal_body.size() == count && body.boundary_area.size() == count);
  Hdf5Group group = bodies.make_group(body.name);
  group.set_attribute("shape", body.shape);
  Hdf5Group boundary = group.make_group("boundary");
  boundary.write("position_body", {count, 3}, flat(body.boundary_position_body));
  boundary.write("normal_body", {count, 3}, flat(body.boundary_normal_body));
  boundary.write("area_m2", {count}, std::span<const double>(body.boundary_area));
  group.write("outline_body", {body.outline_body.size(), 3}, flat(body.outline_body));
  const auto per_frame = [&group](const char* name, const Shape& row) {
    return group.make_growing<double>(name, row, row.size() < 2 ? small_chunk : 1);
  };
  return {.path = "bodies/" + body.name,
          .boundary_particles = count,
          .time = per_frame("time", {}),
          .position = per_frame("position", {3}),
          .orientation = per_frame("orientation_wxyz", {4}),
          .velocity = per_frame("velocity", {3}),
          .angular_velocity = per_frame("angular_velocity", {3}),
          .traction = per_frame("traction_Pa", {count, 3}),
          .impulse = per_frame("impulse_N_s", {count, 3})};
}

void append_body(BodyArrays& arrays, double time, const BodyFrame& frame) {
  arrays.time.append(one(time));
  arrays.position.append(flat(frame.state.position));
  arrays.orientation.append(std::span<const double>(wxyz(frame.state.orientation)));
  arrays.velocity.append(flat(frame.velocity));
  arrays.angular_velocity.append(flat(frame.angular_velocity));
  arrays.traction.append(flat(frame.traction));
  arrays.impulse.append(flat(frame.impulse));
}

void require_finite(const std::filesystem::path& file, const BodyDescription& body) {
  const std::string path = "bodies/" + body.name;
  require_finite(file, path + "/boundary/position_body", flat(body.boundary_position_body), 3);
  require_finite(file, path + "/boundary/normal_body", flat(body.boundary_normal_body), 3);
  require_finite(file, path + "/boundary/area_m2", std::span<const double>(body.boundary_area), 1);
  require_finite(file, path + "/outline_body", flat(body.outline_body), 3);
}

void require_finite(const std::filesystem::path& file, const std::string& path, const BodyFrame& body) {
  require_finite(file, path + "/position", flat(body.state.position), 1);
  require_finite(file, path + "/orientation_wxyz", std::span<const double>(wxyz(body.state.orientation)), 1);
  require_finite(file, path + "/velocity", flat(body.velocity), 1);
  require_finite(file, path + "/angular_velocity", flat(body.angular_velocity), 1);
  require_finite(file, path + "/traction_Pa", flat(body.traction), 3);
  require_finite(file, path + "/impulse_N_s", flat(body.impulse), 3);
}

void require_finite(const std::filesystem::path& file, const IceFrame& ice) {
  require_finite(file, "time", one(ice.time), 1);
  require_finite(file, "position", flat(ice.position), 3);
  for (const Field& field : ice.fields) {
    require_finite(file, field.name, std::span<const float>(field.values), field.components);
  }
}

/// Replaces a file in one move, so that a reader sees the old text or the new one.
void replace_file(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path unfinished = path.string() + ".tmp";
  std::ofstream out(unfinished, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(unfinished.string() + ": cannot write: " + std::strerror(errno));
  std::filesystem::rename(unfinished, path);  // its exception is a std::runtime_error that names both paths
}

}  // namespace

struct ResultWriter::Impl {
  std::filesystem::path h5, xmf;
  Hdf5File file;
  std::vector<BodyArrays> bodies;
  std::optional<IceArrays> ice;  // from the first frame on, which fixes the next two
  std::size_t particles = 0;
  std::vector<XdmfField> fields;
  std::vector<double> times;

  explicit Impl(const std::filesystem::path& directory)
      : h5(directory / "result.h5"), xmf(directory / "result.xmf"), file(h5) {}

  bool fits(const IceFrame& frame, const std::vector<BodyFrame>& body_frames) const;
  void require_finite(const IceFrame& frame, const std::vector<BodyFrame>& body_frames) const;
};

/// Whether sizes and names are those of the descriptions and of the first frame.
bool ResultWriter::Impl::fits(const IceFrame& frame, const std::vector<BodyFrame>& body_frames) const {
  bool good = !frame.position.empty() && body_frames.size() == bodies.size();
  good = good && (!ice || (frame.position.size() == particles && frame.fields.size() == fields.size()));
  for (std::size_t i = 0; good && i < frame.fields.size(); ++i) {
    const Field& field = frame.fields[i];
    good = field.values.size() == field.components * frame.position.size() &&
           (!ice || (field.name == fields[i].name && field.components == fields[i].components));
  }
  for (std::size_t b = 0; good && b < bodies.size(); ++b) {
    good = body_frames[b].traction.size() == bodies[b].boundary_particles &&
           body_frames[b].impulse.size() == bodies[b].boundary_particles;
  }
  return good;
}

void ResultWriter::Impl::require_finite(const IceFrame& frame, const std::vector<BodyFrame>& body_frames) const {
  cases::require_finite(h5, frame);
  for (std::size_t b = 0; b < bodies.size(); ++b) cases::require_finite(h5, bodies[b].path, body_frames[b]);
}

ResultWriter::ResultWriter(const std::filesystem::path& directory, const std::vector<BodyDescription>& bodies) {
  for (const BodyDescription& body : bodies) require_finite(directory / "result.h5", body);
  impl_ = std::make_unique<Impl>(directory);
  std::filesystem::remove(impl_->xmf);  // of an earlier run: it would describe other arrays
  Hdf5Group group = impl_->file.make_group("bodies");
  for (const BodyDescription& body : bodies) impl_->bodies.push_back(make_body(group, body));
  impl_->file.flush();
}

ResultWriter::~ResultWriter() = default;

void ResultWriter::append(const IceFrame& ice, const std::vector<BodyFrame>& bodies) {
  assert(impl_->fits(ice, bodies));
  impl_->require_finite(ice, bodies);
  if (!impl_->ice) {
    impl_->ice = make_ice(impl_->file, ice);
    impl_->particles = ice.position.size();
    for (const Field& field : ice.fields) impl_->fields.push_back({field.name, field.components});
  }
  append_ice(*impl_->ice, ice, impl_->times.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) append_body(impl_->bodies[b], ice.time, bodies[b]);
  impl_->times.push_back(ice.time);
  // NSteps follows the data: a process killed in this function should not leave a step announced without its data.
  impl_->file.flush();
  impl_->ice->steps.set_attribute("NSteps", static_cast<std::int64_t>(impl_->times.size()));
  impl_->file.flush();
  replace_file(impl_->xmf, xdmf(impl_->h5.filename().string(), impl_->times, impl_->particles, impl_->fields));
}

}  // namespace nilas::cases
