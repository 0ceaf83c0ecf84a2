// Exact solutions that the contact cases are compared with, where they take more than a line.
#pragma once

namespace nilas::cases {

/// Smallest positive root of beta tan beta = ratio: lowest mode of a bar with a mass on its end and the other end
/// fixed; ratio: mass of the bar over the mass.
double mode_of_mass_on_bar(double ratio);

/// Hertz's impact of an elastic sphere on a rigid plane (Johnson, Contact Mechanics, 1985, section 11.4).
struct HertzImpact {
  double indentation;     // m, largest
  double force;           // N, largest
  double contact_radius;  // m, largest
  double duration;        // s
  /// effective: mass m [kg], radius R [m] and modulus E* [Pa]; speed of approach v [m/s].
  HertzImpact(double mass, double radius, double modulus, double speed);
};
/// Share of the duration during which the force exceeds `level` times its largest.
double hertz_time_above(double level);

/// Rigid sphere of mass M and radius a in unbounded, inviscid fluid of sound speed c; m: mass of the fluid that it
/// displaces. Everything over time sigma = c t/a, for the initial speed 1.
///
/// The fluid answers the dipole motion with the impedance Z(s) = m s (1 + S)/(2 + 2 S + S^2), S = s a/c (Landau and
/// Lifshitz, Fluid Mechanics, section 74). Then M (s v - v0) = -Z v gives, with mu = m/M,
///     v/v0 = L^-1[(S^2 + 2 S + 2)/(S (S^2 + q S + q))],   q = 2 + mu
///          = 2/q + (1 - 2/q) exp(-q sigma/2) (cos w sigma - q/(2 w) sin w sigma),   w^2 = q - q^2/4 > 0,
/// which tends to M/(M + m/2).
class SphereInFluid {
 public:
  /// mass_ratio: mu = m/M, below 2.
  explicit SphereInFluid(double mass_ratio);
  double velocity(double sigma) const;  // of a sphere that is given the speed 1 at sigma = 0
  double path(double sigma) const;  // its integral: velocity under a steady force that alone would give 1 in sigma 1

 private:
  double q_, w_;
};

}  // namespace nilas::cases
