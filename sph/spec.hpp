// What a caller states about a piece of ice: geometry, material, numerics, contact. Plain structs, filled once and
// handed to one constructor; derived constants (K, G, c, h) are computed by their owner. SI units, world frame.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sph/vector.hpp"

namespace nilas::sph {

enum class IceShape { disc, block, sphere };

/// Which particles are held still for the whole run. `rim` is the circumference of a disc, `faces` are those of the
/// piece's bounding box in the order x-, x+, y-, y+, z-, z+. Held layers are one kernel radius deep.
struct FixedParts {
  bool rim = false;
  std::array<bool, 6> faces{};
};

/// One piece of ice on a cubic lattice. Disc: `diameter`, `thickness`, axis z; with an `inner_diameter` a ring. Block:
/// `size`. Sphere: `diameter`.
struct PieceSpec {
  IceShape shape = IceShape::disc;
  double diameter = 0;           // m
  double inner_diameter = 0;     // m, disc only; 0: solid
  double thickness = 0;          // m
  Vec3 size = Vec3::Zero();      // m
  Vec3 centre = Vec3::Zero();    // m
  Vec3 velocity = Vec3::Zero();  // m/s, initial
  FixedParts fixed;
  bool absorbing_rim = false;  // disc only: stands for a wider sheet (absorbing_rim.hpp)
};

/// elastic: hypo-elastic, Jaumann rate. neo_hookean: from the deformation gradient, with Kelvin-Voigt damping.
/// drucker_prager: elastic up to the cone. rate_dependent: law of the preset "real-ice".
enum class Model { elastic, neo_hookean, drucker_prager, rate_dependent };
/// What ice still carries after its first yield (Drucker-Prager only).
///   plastic       all of its strength (perfect plasticity)
///   cohesionless  friction; neither cohesion, tension nor further dilation
///   fluid         pressure only: no deviatoric stress, no tension (the "damage criterion" of Cai et al. 2025)
///   softening     `residual_strength` times the yield stress and the tension limit, reached linearly over
///                 `softening_strain` of plastic strain (0: at once)
enum class AfterFailure { plastic, cohesionless, fluid, softening };
/// volumetric_strain: dp = -K tr(D) dt. density: p = K (rho/rho0 - 1), so that opened voids must close before the ice
/// carries pressure again.
enum class PressureLaw { volumetric_strain, density };

/// Rate-dependent ice: compressive strength by a power of the strain rate, tension cut-off with fracture energy, shear
/// softening over a slip, residual friction (rate_dependent_ice.hpp says what comes from where).
struct RateDependentSpec {
  double strength_at_unit_rate = 8.9e6;  // Pa, uniaxial compression at 1 /s
  double rate_exponent = 0.15;
  double tensile_strength = 0.5e6;    // Pa
  double fracture_energy = 1;         // J/m2
  double fracture_toughness = 0.1e6;  // Pa sqrt(m)
  double softening_slip = 0.5e-3;     // m, over which a shear band loses its strength
  double residual_friction_angle_deg = 6;
  double largest_bulking = 0.5;  // plastic volume strain that opened voids leave behind, at most

  bool operator==(const RateDependentSpec&) const = default;
};

struct MaterialSpec {
  Model model = Model::drucker_prager;
  double density = 900;           // kg/m3
  double young_modulus = 9.38e9;  // Pa
  double poisson_ratio = 0.33;
  PressureLaw pressure = PressureLaw::volumetric_strain;
  double cohesion = 0.58e6;        // Pa
  double friction_angle_deg = 36;  // deg
  double dilation_angle_deg = 12;  // deg
  AfterFailure after_failure = AfterFailure::fluid;
  double residual_strength = 0;  // softening only, 0..1
  double softening_strain = 0;   // softening only
  double hardening_modulus = 0;  // Pa, of the uniaxial flow stress per plastic strain (Drucker-Prager only)
  double kelvin_voigt = 0;       // neo-Hookean only: damping chi = kelvin_voigt rho c_b h / 2; the paper has 1
  RateDependentSpec rate_dependent;

  bool operator==(const MaterialSpec&) const = default;
};

/// The sound speed on which the CFL number is based: c_b = sqrt(K/rho) (the paper) or c_p = sqrt((K + 4G/3)/rho).
enum class SoundSpeed { bulk, p_wave };
/// Of the pair loops; all state is in double.
enum class Precision { double_, single };

struct NumericsSpec {
  double smoothing_ratio = 1.3;      // h / spacing
  bool gradient_correction = false;  // velocity gradient and stress divergence with the inverse moment matrix
  double viscosity_alpha = 0.1;      // Monaghan, linear term; 0: off
  double viscosity_beta = 0;         // Monaghan, quadratic term
  // Terms that are off at 0; each has a source file of its own that says what it does.
  double artificial_stress = 0;           // epsilon
  double artificial_stress_exponent = 4;  // n
  double density_diffusion = 0;           // delta
  int density_reinitialisation = 0;       // every so many steps
  double shifting = 0;                    // share of Fick's displacement
  double hourglass_control = 0;           // xi; only with gradient_correction
  double cfl = 0.6;
  SoundSpeed cfl_sound_speed = SoundSpeed::bulk;
  double max_step = 0;             // s, 0: no limit
  double max_coupling_number = 0;  // of the exchange with a free body, coupling/stability_number.hpp; 0: no limit
  double quiet_speed = 0;          // m/s: ice that no faster wave has reached sleeps, quiet_ice.hpp; 0: none does
  double skin_ratio = 0.15;        // neighbour-list skin / kernel radius: speed only, never the result beyond round-off
  Precision precision = Precision::double_;
  double sound_speed_scale = 1;  // 0..1: softer ice than stated, for a larger step; reduced_stiffness.hpp
};

/// Damped penalty between ice and boundary particles, with optional Coulomb friction or stick.
struct ContactSpec {
  double stiffness = 0.2;           // times the P-wave modulus, per spacing
  double damping = 0.4;             // times the impedance rho c_p
  double tangential_damping = 0.4;  // times the shear impedance rho c_s; only with friction or stick
  double friction_coefficient = 0;
  bool stick = false;
};

/// All ice of a run: pieces of one material on one lattice spacing.
struct IceSpec {
  std::vector<PieceSpec> pieces;
  double spacing = 0;              // m
  std::array<bool, 3> periodic{};  // axes along which all pieces have the same extent and wrap onto themselves
  double jitter = 0;            // largest random displacement of a particle along each axis at the start, in spacings
  Vec3 gravity = Vec3::Zero();  // m/s2
  MaterialSpec material;
  NumericsSpec numerics;
  ContactSpec contact;
};

}  // namespace nilas::sph
