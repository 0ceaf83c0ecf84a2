#include "sph/lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace nilas::sph {
namespace {

IceSpec block(const Vec3& size, double spacing) {
  IceSpec spec;
  PieceSpec piece;
  piece.shape = IceShape::block;
  piece.size = size;
  spec.pieces = {piece};
  spec.spacing = spacing;
  return spec;
}

IceSpec round(IceShape shape, double diameter, double thickness, double spacing) {
  IceSpec spec = block(Vec3::Zero(), spacing);
  spec.pieces[0].shape = shape;
  spec.pieces[0].diameter = diameter;
  spec.pieces[0].thickness = thickness;
  return spec;
}

double volume(const Particles& p) {
  double sum = 0;
  for (const Motion& m : p.motion) sum += m.volume;
  return sum;
}

Vec3 mean_position(const Particles& p) {
  Vec3 sum = Vec3::Zero();
  for (const Motion& m : p.motion) sum += m.position;
  return sum / static_cast<double>(p.size());
}

TEST(Lattice, BlockHasItsCellsVolumeAndMass) {
  const IceSpec spec = block({0.4, 0.2, 0.1}, 0.02);
  const Particles p = lattice(spec);
  EXPECT_EQ(p.size(), 20u * 10 * 5);
  EXPECT_NEAR(volume(p) / 0.008, 1, 1e-12);
  EXPECT_NEAR(p.mass * static_cast<double>(p.size()) / (900 * 0.008), 1, 1e-12);
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_NEAR(p.density(i) / 900, 1, 1e-12);
}

TEST(Lattice, BlockIsCellCentredAboutItsCentre) {
  IceSpec spec = block({0.4, 0.2, 0.1}, 0.02);
  spec.pieces[0].centre = {1, -2, 3};
  const Particles p = lattice(spec);
  EXPECT_LT((mean_position(p) - spec.pieces[0].centre).norm(), 1e-12);
  Vec3 lower = Vec3::Constant(1e9), upper = -lower;
  for (const Motion& m : p.motion) lower = lower.cwiseMin(m.position), upper = upper.cwiseMax(m.position);
  EXPECT_LT((upper - lower - Vec3(0.38, 0.18, 0.08)).norm(), 1e-12);
}

TEST(Lattice, ExtentIsRoundedToWholeSpacingsAndAtLeastOne) {
  EXPECT_EQ(lattice(block({0.109, 0.001, 0.051}, 0.02)).size(), 5u * 1 * 3);
}

TEST(Lattice, DiscAndSphereKeepCellsWhoseCentreLiesInside) {
  const Particles disc = lattice(round(IceShape::disc, 1.2, 0.1, 0.02));
  for (const Motion& m : disc.motion) EXPECT_LE(m.position.head<2>().norm(), 0.6);
  EXPECT_NEAR(volume(disc) / (std::numbers::pi / 4 * 1.2 * 1.2 * 0.1), 1, 0.02);
  const Particles sphere = lattice(round(IceShape::sphere, 0.8, 0, 0.02));
  for (const Motion& m : sphere.motion) EXPECT_LE(m.position.norm(), 0.4);
  EXPECT_NEAR(volume(sphere) / (std::numbers::pi / 6 * 0.8 * 0.8 * 0.8), 1, 0.02);
}

TEST(Lattice, EveryPieceIsSymmetricAboutItsCentre) {
  for (const IceSpec& spec : {round(IceShape::disc, 0.31, 0.05, 0.02), round(IceShape::disc, 0.3, 0.06, 0.02),
                              round(IceShape::sphere, 0.3, 0, 0.02)}) {
    const Particles p = lattice(spec);
    for (int axis = 0; axis < 3; ++axis) {
      std::size_t above = 0, below = 0;
      for (const Motion& m : p.motion) above += m.position[axis] > 1e-9, below += m.position[axis] < -1e-9;
      EXPECT_EQ(above, below);
    }
    EXPECT_LT(mean_position(p).norm(), 1e-12);
  }
}

TEST(Lattice, EstimateIsExactForBlocksAndWithinTwoPercentForRoundPieces) {
  for (const IceSpec& spec : {block({0.41, 0.2, 0.001}, 0.02), block({0.109, 0.3, 0.07}, 0.013)})
    EXPECT_EQ(estimated_particles(spec), static_cast<double>(lattice(spec).size()));
  for (const IceSpec& spec : {round(IceShape::disc, 1.2, 0.3, 0.02), round(IceShape::disc, 0.8, 0.1, 0.02),
                              round(IceShape::sphere, 0.061, 0, 0.001356), round(IceShape::sphere, 0.8, 0, 0.02)})
    EXPECT_NEAR(estimated_particles(spec) / static_cast<double>(lattice(spec).size()), 1, 0.02);
}

TEST(Lattice, SecondPieceFollowsTheFirst) {
  IceSpec spec = block({0.1, 0.1, 0.1}, 0.02);
  spec.pieces.push_back(spec.pieces[0]);
  spec.pieces[1].centre = {0.5, 0, 0};
  spec.pieces[1].velocity = {-1, 0, 0};
  const Particles p = lattice(spec);
  ASSERT_EQ(p.size(), 250u);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_EQ(p.id[i], i);
    EXPECT_EQ(p.motion[i].velocity[0], i < 125 ? 0 : -1);
    EXPECT_EQ(p.motion[i].position[0] > 0.3, i >= 125);
  }
}

TEST(Lattice, VelocityIsThatOfThePiecePlusTheField) {
  IceSpec spec = block({0.1, 0.1, 0.1}, 0.02);
  spec.pieces[0].velocity = {1, 2, 3};
  const Particles p = lattice(spec, {.velocity = [](const Vec3& x) { return Vec3(10 * x[1], 0, 0); }});
  for (const Motion& m : p.motion) EXPECT_LT((m.velocity - Vec3(1 + 10 * m.position[1], 2, 3)).norm(), 1e-12);
}

TEST(Lattice, HeldParticlesLieWithinOneKernelRadiusOfTheFixedFaces) {
  const double depth = 2 * 1.3 * 0.02;
  for (int face = 0; face < 6; ++face) {
    IceSpec spec = block({0.3, 0.3, 0.3}, 0.02);
    spec.pieces[0].centre = {5, 6, 7};
    spec.pieces[0].fixed.faces[face] = true;
    const Particles p = lattice(spec);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double s = (face % 2 ? 1 : -1) * (p.motion[i].position - spec.pieces[0].centre)[face / 2];
      EXPECT_EQ(p.held[i] != 0, 0.15 - s < depth) << "face " << face;
    }
  }
}

TEST(Lattice, HeldParticlesOfADiscLieWithinOneKernelRadiusOfTheRim) {
  IceSpec spec = round(IceShape::disc, 0.6, 0.1, 0.02);
  spec.pieces[0].fixed.rim = true;
  const Particles p = lattice(spec);
  for (std::size_t i = 0; i < p.size(); ++i)
    EXPECT_EQ(p.held[i] != 0, p.motion[i].position.head<2>().norm() > 0.3 - 0.052);
}

TEST(Lattice, HeldParticlesDoNotMove) {
  IceSpec spec = block({0.3, 0.1, 0.1}, 0.02);
  spec.pieces[0].velocity = {1, 2, 3};
  spec.pieces[0].fixed.faces[0] = true;
  const Particles p = lattice(spec, {.velocity = [](const Vec3&) { return Vec3(4, 5, 6); }});
  ASSERT_GT(std::count(p.held.begin(), p.held.end(), 1), 0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.held[i]) {
      EXPECT_EQ(p.motion[i].velocity, Vec3::Zero());
    }
  }
}

TEST(Lattice, FieldsOfTermsThatAreOffStayEmpty) {
  for (const bool corrected : {false, true})
    for (const Model model : {Model::elastic, Model::neo_hookean, Model::drucker_prager, Model::rate_dependent})
      for (const PressureLaw pressure : {PressureLaw::volumetric_strain, PressureLaw::density}) {
        IceSpec spec = block({0.1, 0.1, 0.1}, 0.02);
        spec.numerics.gradient_correction = corrected;
        spec.material.model = model;
        spec.material.pressure = pressure;
        const Particles p = lattice(spec);
        const bool damage = model == Model::rate_dependent, plastic = model == Model::drucker_prager || damage;
        const bool bulking = damage || (plastic && pressure == PressureLaw::density);
        EXPECT_EQ(p.correction.size(), corrected ? p.size() : 0);
        EXPECT_EQ(p.plastic_strain.size(), plastic ? p.size() : 0);
        EXPECT_EQ(p.failed.size(), plastic ? p.size() : 0);
        EXPECT_EQ(p.bulking.size(), bulking ? p.size() : 0);
        EXPECT_EQ(p.strain_rate.size(), damage ? p.size() : 0);
        EXPECT_EQ(p.tensile_damage.size(), damage ? p.size() : 0);
        EXPECT_EQ(p.shear_damage.size(), damage ? p.size() : 0);
        EXPECT_EQ(p.deformation_gradient.size(), model == Model::neo_hookean ? p.size() : 0);
        EXPECT_EQ(p.stress.size(), p.size());
        EXPECT_EQ(p.velocity_gradient.size(), p.size());
        EXPECT_EQ(p.acceleration.size(), p.size());
      }
}

TEST(Lattice, PieceWithoutParticlesIsRefused) {
  EXPECT_THROW(lattice(round(IceShape::sphere, 0.031, 0, 0.02)), std::invalid_argument);
}

TEST(Lattice, OverlappingPiecesAreRefused) {
  IceSpec spec = block({0.1, 0.1, 0.1}, 0.02);
  spec.pieces.push_back(spec.pieces[0]);
  spec.pieces[1].centre = {0.05, 0.004, 0};
  EXPECT_THROW(lattice(spec), std::invalid_argument);
  spec.pieces[1].centre = {0.089, 0, 0};  // last layer of one 9 mm from the first of the other
  EXPECT_THROW(lattice(spec), std::invalid_argument);
}

TEST(Lattice, PiecesThatTouchAreAllowed) {
  IceSpec spec = block({0.1, 0.1, 0.1}, 0.02);
  spec.pieces.push_back(spec.pieces[0]);
  spec.pieces[1].centre = {0.1, 0, 0};
  EXPECT_EQ(lattice(spec).size(), 250u);
}

TEST(Lattice, DisplacementMovesWhatIsNotHeldAndNothingElse) {
  IceSpec spec = block({0.4, 0.1, 0.1}, 0.02);
  spec.pieces[0].fixed.faces[1] = true;
  const Particles plain = lattice(spec);
  const auto shift = [](const Vec3& x) { return Vec3(0.01 * x.y(), 0.003, 0); };
  const Particles moved = lattice(spec, {.displacement = shift});
  ASSERT_EQ(moved.size(), plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const Vec3 site = plain.motion[i].position;
    EXPECT_EQ(moved.motion[i].position, plain.held[i] ? site : Vec3(site + shift(site)));
    EXPECT_EQ(moved.motion[i].volume, plain.motion[i].volume);
  }
}

}  // namespace
}  // namespace nilas::sph
