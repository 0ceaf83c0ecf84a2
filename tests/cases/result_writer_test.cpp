#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "tests/cases/hdf5_reading.hpp"
#include "tests/cases/known_result.hpp"

namespace nilas::test {
namespace {

namespace fs = std::filesystem;
using cases::BodyFrame;
using cases::IceFrame;
using cases::ResultWriter;
using Shape = std::vector<hsize_t>;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

std::string bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class ResultWriterTest : public testing::Test {
 protected:
  // One directory per test: tests run in parallel.
  fs::path directory = fs::path(testing::TempDir()) /
                       (std::string("nilas-") + testing::UnitTest::GetInstance()->current_test_info()->name());
  fs::path h5 = directory / "result.h5";

  void SetUp() override {
    fs::remove_all(directory);
    fs::create_directories(directory);
  }
  void TearDown() override { fs::remove_all(directory); }

  void write_frames(int frames) const {
    ResultWriter writer(directory, {known_body()});
    for (int frame = 0; frame < frames; ++frame) writer.append(known_ice(frame), {known_body_frame(frame)});
  }

  /// What is on disk now, as it would be if the process were killed here. (The library would answer for a file that
  /// this process has open from its memory.)
  Hdf5Reading on_disk() const {
    const fs::path copy = directory / "copy.h5";
    fs::copy_file(h5, copy, fs::copy_options::overwrite_existing);
    return Hdf5Reading(copy);
  }
};

TEST_F(ResultWriterTest, PositionsAreReadBackExactlyAtEachTime) {
  write_frames(3);
  const Array points = Hdf5Reading(h5).array("/VTKHDF/Points");
  ASSERT_EQ(points.shape, (Shape{3 * known_particles, 3}));
  for (int frame = 0; frame < 3; ++frame) {
    const IceFrame ice = known_ice(frame);
    for (int i = 0; i < known_particles; ++i) {
      const double* read = &points.values[3 * (frame * known_particles + i)];
      EXPECT_EQ(Vec3(read[0], read[1], read[2]), ice.position[i]) << "frame " << frame << " particle " << i;
    }
  }
}

TEST_F(ResultWriterTest, FieldsAreReadBackExactlyAtEachTimeInSinglePrecision) {
  write_frames(3);
  const Hdf5Reading file(h5);
  for (std::size_t f = 0; f < 2; ++f) {
    std::vector<double> expected;
    for (int frame = 0; frame < 3; ++frame) {
      const auto values = known_ice(frame).fields[f].values;
      expected.insert(expected.end(), values.begin(), values.end());
    }
    const std::string name = "/VTKHDF/PointData/" + known_ice(0).fields[f].name;
    EXPECT_EQ(file.array(name).values, expected);
    EXPECT_EQ(file.bytes_per_value(name), 4u);
  }
  EXPECT_EQ(file.array("/VTKHDF/PointData/pressure_Pa").shape, (Shape{3 * known_particles}));
  EXPECT_EQ(file.array("/VTKHDF/PointData/velocity_m_s").shape, (Shape{3 * known_particles, 3}));
  EXPECT_EQ(file.bytes_per_value("/VTKHDF/Points"), 8u);
}

TEST_F(ResultWriterTest, StepsOfVtkhdfPointAtTheirRowsAndAtTheConstantCells) {
  write_frames(3);
  const Hdf5Reading file(h5);
  const double n = known_particles;
  EXPECT_EQ(file.text_attribute("/VTKHDF", "Type"), "PolyData");
  EXPECT_EQ(file.integer_attribute("/VTKHDF/Steps", "NSteps"), 3);
  EXPECT_EQ(file.array("/VTKHDF/Steps/Values").values, (std::vector<double>{0, 5e-4, 1e-3}));
  EXPECT_EQ(file.array("/VTKHDF/Steps/PointOffsets").values, (std::vector<double>{0, n, 2 * n}));
  EXPECT_EQ(file.array("/VTKHDF/Steps/PointDataOffsets/velocity_m_s").values, (std::vector<double>{0, n, 2 * n}));
  EXPECT_EQ(file.array("/VTKHDF/Steps/NumberOfParts").values, (std::vector<double>{1, 1, 1}));
  EXPECT_EQ(file.array("/VTKHDF/Steps/PartOffsets").values, (std::vector<double>{0, 0, 0}));
  for (const char* name : {"CellOffsets", "ConnectivityIdOffsets"}) {
    const Array offsets = file.array(std::string("/VTKHDF/Steps/") + name);
    EXPECT_EQ(offsets.shape, (Shape{3, 4})) << name;
    EXPECT_EQ(offsets.values, std::vector<double>(12, 0.0)) << name;
  }
}

TEST_F(ResultWriterTest, EachParticleIsOneVertexAndNothingElse) {
  write_frames(2);
  const Hdf5Reading file(h5);
  EXPECT_EQ(file.array("/VTKHDF/NumberOfPoints").values, (std::vector<double>{known_particles}));
  EXPECT_EQ(file.array("/VTKHDF/Vertices/NumberOfCells").values, (std::vector<double>{known_particles}));
  EXPECT_EQ(file.array("/VTKHDF/Vertices/NumberOfConnectivityIds").values, (std::vector<double>{known_particles}));
  EXPECT_EQ(file.array("/VTKHDF/Vertices/Connectivity").values, (std::vector<double>{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(file.array("/VTKHDF/Vertices/Offsets").values, (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7}));
  for (const std::string kind : {"Lines", "Polygons", "Strips"}) {
    EXPECT_EQ(file.array("/VTKHDF/" + kind + "/NumberOfCells").values, std::vector<double>{0}) << kind;
    EXPECT_EQ(file.array("/VTKHDF/" + kind + "/NumberOfConnectivityIds").values, std::vector<double>{0}) << kind;
    EXPECT_EQ(file.array("/VTKHDF/" + kind + "/Offsets").values, std::vector<double>{0}) << kind;
    EXPECT_EQ(file.array("/VTKHDF/" + kind + "/Connectivity").shape, Shape{0}) << kind;
  }
}

TEST_F(ResultWriterTest, BodiesAreReadBackExactlyAtEachTime) {
  write_frames(3);
  const Hdf5Reading file(h5);
  EXPECT_EQ(file.text_attribute("/bodies/hcc", "shape"), "hcc");
  EXPECT_EQ(file.array("/bodies/hcc/time").values, (std::vector<double>{0, 5e-4, 1e-3}));
  EXPECT_EQ(file.array("/bodies/hcc/position").values,
            (std::vector<double>{0, 0, -1, 0, 0, -1 + 80 * 5e-4, 0, 0, -1 + 80 * 1e-3}));
  EXPECT_EQ(file.array("/bodies/hcc/orientation_wxyz").values,
            (std::vector<double>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}));
  EXPECT_EQ(file.array("/bodies/hcc/velocity").values, (std::vector<double>{0, 0, 80, 0, 0, 80, 0, 0, 80}));
  EXPECT_EQ(file.array("/bodies/hcc/angular_velocity").values, (std::vector<double>{0, 0, 20, 0, 0, 20, 0, 0, 20}));
  const Array traction = file.array("/bodies/hcc/traction_Pa"), impulse = file.array("/bodies/hcc/impulse_N_s");
  EXPECT_EQ(traction.shape, (Shape{3, 2, 3}));
  EXPECT_EQ(impulse.shape, (Shape{3, 2, 3}));
  // at 1 ms, boundary particle 1
  EXPECT_EQ(std::vector(traction.values.end() - 3, traction.values.end()), (std::vector<double>{1, 0, -1e6 * 1e-3}));
  EXPECT_EQ(std::vector(impulse.values.end() - 3, impulse.values.end()), (std::vector<double>{0.125 * 1e-3, 0, 0}));
}

TEST_F(ResultWriterTest, WhatIsConstantOfABodyIsThereBeforeTheFirstFrame) {
  const ResultWriter writer(directory, {known_body()});
  const Hdf5Reading file = on_disk();
  EXPECT_EQ(file.array("/bodies/hcc/boundary/position_body").values, (std::vector<double>{0, 0, 1, 0, 0.25, 0}));
  EXPECT_EQ(file.array("/bodies/hcc/boundary/normal_body").values, (std::vector<double>{0, 0, 1, 0, 1, 0}));
  EXPECT_EQ(file.array("/bodies/hcc/boundary/area_m2").values, (std::vector<double>{0.5, 0.125}));
  EXPECT_EQ(file.array("/bodies/hcc/outline_body").shape, (Shape{4, 3}));
}

TEST_F(ResultWriterTest, BothFilesAreCompleteOnDiskAfterEachAppend) {
  ResultWriter writer(directory, {known_body()});
  // More frames than the rows of one chunk of the small datasets.
  for (int frame = 0; frame < 300; ++frame) {
    writer.append(known_ice(frame), {known_body_frame(frame)});
    if (frame > 3 && frame < 254) continue;
    const Hdf5Reading file = on_disk();
    ASSERT_EQ(file.integer_attribute("/VTKHDF/Steps", "NSteps"), frame + 1);
    ASSERT_EQ(file.array("/VTKHDF/Steps/Values").values.back(), known_time(frame));
    ASSERT_EQ(file.array("/VTKHDF/Points").shape[0], (frame + 1u) * known_particles);
    ASSERT_EQ(file.array("/VTKHDF/PointData/pressure_Pa").values.back(), known_ice(frame).fields[0].values.back());
    ASSERT_EQ(file.array("/bodies/hcc/traction_Pa").values.back(), -1e6 * known_time(frame) * 1);
    const std::string text = bytes(directory / "result.xmf");
    ASSERT_TRUE(text.ends_with("</Xdmf>\n"));
    std::size_t times = 0;
    for (std::size_t at = 0; (at = text.find("<Time ", at)) != std::string::npos; ++at) ++times;
    ASSERT_EQ(times, frame + 1u);
  }
}

TEST_F(ResultWriterTest, ANonFiniteValueIsRefusedByNameAndIndexAndLeavesTheFilesUnchanged) {
  IceFrame bad_time = known_ice(2), bad_position = known_ice(2), bad_field = known_ice(2);
  bad_time.time = nan;
  bad_position.position[4].y() = -std::numeric_limits<double>::infinity();
  bad_field.fields[1].values[3 * 5 + 2] = nan;
  BodyFrame bad_state = known_body_frame(2), bad_traction = known_body_frame(2);
  bad_state.state.orientation.x() = nan;
  bad_traction.traction[1].z() = nan;
  struct Case {
    IceFrame ice;
    BodyFrame body;
    std::string named;
  };
  const std::vector<Case> cases{{bad_time, known_body_frame(2), "time[0] is nan"},
                                {bad_position, known_body_frame(2), "position[4][1] is -inf"},
                                {bad_field, known_body_frame(2), "velocity_m_s[5][2] is nan"},
                                {known_ice(2), bad_state, "bodies/hcc/orientation_wxyz[1] is nan"},
                                {known_ice(2), bad_traction, "bodies/hcc/traction_Pa[1][2] is nan"}};

  ResultWriter writer(directory, {known_body()});
  for (int frame = 0; frame < 2; ++frame) writer.append(known_ice(frame), {known_body_frame(frame)});
  const std::string h5_before = bytes(h5), xmf_before = bytes(directory / "result.xmf");
  for (const Case& c : cases) {
    try {
      writer.append(c.ice, {c.body});
      FAIL() << "written: " << c.named;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(c.named), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(h5.string()), std::string::npos) << error.what();
    }
    EXPECT_TRUE(bytes(h5) == h5_before) << c.named;
    EXPECT_TRUE(bytes(directory / "result.xmf") == xmf_before) << c.named;
  }
  // The writer goes on as if nothing had been asked.
  writer.append(known_ice(2), {known_body_frame(2)});
  EXPECT_EQ(on_disk().array("/VTKHDF/Steps/Values").values, (std::vector<double>{0, 5e-4, 1e-3}));
}

TEST_F(ResultWriterTest, ANonFiniteDescriptionIsRefusedAndNoFileIsMade) {
  cases::BodyDescription body = known_body();
  body.boundary_area[1] = nan;
  EXPECT_THROW(ResultWriter(directory, {body}), std::runtime_error);
  EXPECT_FALSE(fs::exists(h5));
}

TEST_F(ResultWriterTest, ARunWithoutBodiesWritesItsParticles) {
  ResultWriter writer(directory, {});
  writer.append(known_ice(0), {});
  EXPECT_EQ(on_disk().array("/VTKHDF/Points").shape, (Shape{known_particles, 3}));
}

TEST_F(ResultWriterTest, TheSidecarOfAnEarlierRunIsGoneBeforeTheFirstFrame) {
  write_frames(2);
  const ResultWriter writer(directory, {known_body()});
  EXPECT_FALSE(fs::exists(directory / "result.xmf"));
}

TEST_F(ResultWriterTest, AMissingDirectoryIsAnErrorThatNamesTheFileAndTheReason) {
  const fs::path missing = directory / "missing";
  try {
    ResultWriter writer(missing, {});
    FAIL() << "made";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find((missing / "result.h5").string()), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("No such file or directory"), std::string::npos) << error.what();
  }
}

// Any write to /dev/full fails as on a full disk.
TEST_F(ResultWriterTest, AFullDiskIsAnErrorThatNamesTheFileAndTheReason) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  ResultWriter writer(directory, {});
  fs::create_symlink("/dev/full", directory / "result.xmf.tmp");
  try {
    writer.append(known_ice(0), {});
    FAIL() << "written";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("result.xmf"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("No space left on device"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace nilas::test
