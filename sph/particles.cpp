#include "sph/particles.hpp"

#include <memory>
#include <type_traits>

namespace nilas::sph {

namespace {
/// Room for one quantity of all particles, the longest first; not filled before it is used, so that all threads do so.
class Scratch {
 public:
  explicit Scratch(std::size_t bytes) : memory_(std::make_unique_for_overwrite<Line[]>(bytes / sizeof(Line) + 1)) {}
  template <class T>
  T* as() {
    static_assert(std::is_trivially_destructible_v<T> && alignof(T) <= alignof(Line));
    return reinterpret_cast<T*>(memory_.get());
  }

 private:
  struct alignas(64) Line {
    std::byte bytes[64];
  };
  std::unique_ptr<Line[]> memory_;
};

template <class T>
void permute_one(std::vector<T>& values, const std::vector<std::uint32_t>& order, Scratch& scratch) {
  if (values.empty()) return;
  T* const sorted = scratch.as<T>();
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (std::size_t i = 0; i < order.size(); ++i) std::construct_at(sorted + i, values[order[i]]);
#pragma omp for schedule(static)
    for (std::size_t i = 0; i < order.size(); ++i) values[i] = sorted[i];
  }
}
}  // namespace

void Particles::permute(const std::vector<std::uint32_t>& order) {
  Scratch scratch(sizeof(Mat3) * size());
  permute_one(motion, order, scratch);
  permute_one(stress, order, scratch);
  permute_one(velocity_gradient, order, scratch);
  permute_one(acceleration, order, scratch);
  permute_one(held, order, scratch);
  permute_one(id, order, scratch);
  permute_one(correction, order, scratch);
  permute_one(stabilisation, order, scratch);
  permute_one(plastic_strain, order, scratch);
  permute_one(failed, order, scratch);
  permute_one(bulking, order, scratch);
  permute_one(strain_rate, order, scratch);
  permute_one(tensile_damage, order, scratch);
  permute_one(shear_damage, order, scratch);
  permute_one(deformation_gradient, order, scratch);
}

}  // namespace nilas::sph
