#include "sph/particles.hpp"

namespace nilas::sph {

namespace {
template <class T>
void permute_one(std::vector<T>& values, const std::vector<std::uint32_t>& order) {
  if (values.empty()) return;
  std::vector<T> sorted(values.size());
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = values[order[i]];
  values.swap(sorted);
}
}  // namespace

void Particles::permute(const std::vector<std::uint32_t>& order) {
  permute_one(motion, order);
  permute_one(stress, order);
  permute_one(velocity_gradient, order);
  permute_one(acceleration, order);
  permute_one(held, order);
  permute_one(id, order);
  permute_one(correction, order);
  permute_one(stabilisation, order);
  permute_one(plastic_strain, order);
  permute_one(failed, order);
  permute_one(bulking, order);
  permute_one(strain_rate, order);
  permute_one(tensile_damage, order);
  permute_one(shear_damage, order);
  permute_one(deformation_gradient, order);
}

}  // namespace nilas::sph
