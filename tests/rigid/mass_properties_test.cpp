#include "rigid/mass_properties.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/rigid/shape_oracle.hpp"

namespace nilas::rigid {
namespace {

const Shape hcc = Hcc{1.8, 0.3, 0.2};

std::string refusal(const MassProperties& mass) {
  try {
    check(mass, hcc);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

// Verification problem V35; the reference values are given to seven digits.
TEST(MassProperties, OfTheHccAreThoseOfItsGeometryAndDensity) {
  const MassProperties mass = from_density(hcc, 1500);
  EXPECT_NEAR(mass.mass, 183.783, 0.0005);
  EXPECT_NEAR(-mass.centre_of_mass.z(), 0.932692, 0.5e-6);
  EXPECT_EQ(mass.centre_of_mass.head<2>(), Eigen::Vector2d::Zero());
  EXPECT_NEAR(mass.inertia.x(), 47.23377, 0.5e-5);
  EXPECT_EQ(mass.inertia.y(), mass.inertia.x());
  EXPECT_NEAR(mass.inertia.z(), 2.035752, 0.5e-6);
}

TEST(MassProperties, OfEveryShapeAreThoseOfQuadratureAndFeasible) {
  for (const oracle::Case& c : oracle::cases()) {
    const oracle::Integrals expected = oracle::integrate(c.shape);
    const MassProperties mass = from_density(c.shape, 917);
    EXPECT_NEAR(mass.mass, 917 * expected.volume, 1e-8 * mass.mass) << c.name;
    EXPECT_LT((mass.inertia - mass.mass * expected.inertia_per_mass).norm(), 1e-8 * mass.inertia.norm()) << c.name;
    EXPECT_TRUE(check(mass, c.shape).empty()) << c.name;
  }
}

TEST(MassProperties, FromMassScaleThoseFromDensity) {
  const MassProperties unit = from_density(hcc, 1);
  const MassProperties mass = from_mass(hcc, 174.1);
  EXPECT_EQ(mass.mass, 174.1);
  EXPECT_EQ(mass.centre_of_mass, unit.centre_of_mass);
  EXPECT_LT((mass.inertia - 174.1 / unit.mass * unit.inertia).norm(), 1e-13 * mass.inertia.norm());
  EXPECT_NEAR(mass.inertia.x(), 44.75, 0.005);  // the figure of the paper's mass
}

TEST(MassProperties, InfeasibleAxialMomentOfThePaperGivesOneWarningWithNumberAndBound) {
  const MassProperties printed{174.1, {0, 0, -0.9333}, {21.4, 21.4, 6.15}};
  const std::vector<std::string> warnings = check(printed, hcc);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "inertia about z = 6.15 kg m2 exceeds m R^2 = 3.91725 kg m2 (m = 174.1 kg, R = 0.15 m): no distribution of "
            "that mass inside the hcc can have it");
}

TEST(MassProperties, HoopAtTheLargestRadiusIsJustFeasible) {
  const double bound = 174.1 * 0.15 * 0.15;
  EXPECT_TRUE(check({174.1, {0, 0, -0.9333}, {21.4, 21.4, bound}}, hcc).empty());
  EXPECT_EQ(check({174.1, {0, 0, -0.9333}, {21.4, 21.4, bound * (1 + 1e-9)}}, hcc).size(), 1u);
}

TEST(MassProperties, TransverseMomentsAreBoundedByTheFarthestPointFromTheirAxis) {
  // From the centre of mass at 0.9 m the rim of the tail is farthest.
  const double bound = 100 * (0.9 * 0.9 + 0.15 * 0.15);
  EXPECT_TRUE(check({100, {0, 0, -0.9}, Vec3(bound * (1 - 1e-9), bound * (1 - 1e-9), 1)}, hcc).empty());
  EXPECT_EQ(check({100, {0, 0, -0.9}, Vec3(bound * (1 + 1e-9), bound * (1 + 1e-9), 1)}, hcc).size(), 2u);
}

TEST(MassProperties, CentreOfMassOutsideTheShapeGivesAWarning) {
  const std::vector<std::string> warnings = check({174.1, {0, 0, 0.5}, {21.4, 21.4, 2}}, hcc);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].find("centre of mass (  0   0 0.5) m lies 0.5 m outside the hcc"), 0u) << warnings[0];
  EXPECT_TRUE(check({174.1, {0, 0, 0}, {21.4, 21.4, 2}}, hcc).empty());  // on the tip
}

TEST(MassProperties, ViolatingTheTriangleInequalityAreRefused) {
  EXPECT_EQ(refusal({10, {0, 0, -0.9}, {1, 2, 3.1}}),
            "inertia about z = 3.1 kg m2, must not exceed the sum of the others, 1 + 2 kg m2 (triangle inequality: no "
            "matter has such moments)");
  EXPECT_NE(refusal({10, {0, 0, -0.9}, {3.1, 2, 1}}).find("inertia about x = 3.1"), std::string::npos);
  EXPECT_NE(refusal({10, {0, 0, -0.9}, {1, 3.1, 2}}).find("inertia about y = 3.1"), std::string::npos);
}

TEST(MassProperties, OfAFlatBodyMeetTheTriangleInequalityWithEquality) {
  EXPECT_NO_THROW(check({10, {0, 0, -0.9}, {0.1, 0.2, 0.1 + 0.2}}, hcc));
}

TEST(MassProperties, NotPositiveAndFiniteAreRefusedByNameAndValue) {
  EXPECT_EQ(refusal({0, {0, 0, -0.9}, {1, 1, 1}}), "mass = 0 kg, must be positive and finite");
  EXPECT_EQ(refusal({1, {0, 0, -0.9}, {1, -1, 1}}), "inertia about y = -1 kg m2, must be positive and finite");
  EXPECT_EQ(refusal({1, {0, 0, -0.9}, {1, 1, INFINITY}}), "inertia about z is not finite, must be positive and finite");
  EXPECT_EQ(refusal({1, {0, 0, NAN}, {1, 1, 1}}), "centre of mass is not finite");
  EXPECT_THROW(from_density(hcc, -1), std::invalid_argument);
  EXPECT_THROW(from_mass(hcc, NAN), std::invalid_argument);
  EXPECT_THROW(from_mass(Hcc{1.8, 0.3, 2}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace nilas::rigid
