// A rigid mass that strikes an elastic bar, hosted by Bullet: what its motion keeps whatever the numerics. That it
// follows St Venant's solution is verification case V20.
#include <gtest/gtest.h>

#include "cases/accuracy/struck_bar.hpp"
#include "coupling/simulation.hpp"

namespace nilas::cases {
namespace {

constexpr double kLength = 0.16, kSpacing = 0.004;  // m
constexpr double kSpeed = 1;                        // m/s
constexpr double kMass = 0.1;                       // kg, about that of the bar

class MassOnBar {
 public:
  explicit MassOnBar(rigid::Motion motion) {
    const sph::IceSpec ice = elastic_bar(nilas_scheme(), kLength, kSpacing, false);
    const double end = 1.9 * kLength / sph::ElasticConstants(ice.material).p_wave_speed();
    simulation_ = std::make_unique<Simulation>(ice, std::vector{mass_on_end(ice, kMass, kSpeed, motion)}, end / 20);
    simulation_->advance_to(end);
  }
  Impact& impact() { return simulation_->impact(); }
  const Body& body() { return impact().bodies()[0]; }
  Vec3 total_momentum() { return impact().ice().ledger().momentum + body().state().momentum; }

 private:
  std::unique_ptr<Simulation> simulation_;
};

TEST(MassOnBar, KeepsTheTotalMomentum) {
  for (const auto motion : {rigid::Motion::free, rigid::Motion::translation_only}) {
    MassOnBar run(motion);
    ASSERT_LT(run.body().velocity().x(), 0.9 * kSpeed);
    EXPECT_LT((run.total_momentum() - Vec3(kMass * kSpeed, 0, 0)).norm(), 1e-10 * kMass * kSpeed);
    EXPECT_LT(run.impact().ledger().momentum_residual, 1e-10);
    EXPECT_LT(run.impact().ledger().energy_residual, 0.01);
  }
}

TEST(MassOnBar, FreeToTurnGoesStraightOnAsOneThatIsNot) {
  MassOnBar turning(rigid::Motion::free), sliding(rigid::Motion::translation_only);
  EXPECT_LT((turning.body().velocity() - sliding.body().velocity()).norm(), 1e-10 * kSpeed);
  EXPECT_LT(turning.body().angular_velocity().norm() * kLength, 1e-10 * kSpeed);
}

}  // namespace
}  // namespace nilas::cases
