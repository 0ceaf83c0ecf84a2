// The parts of the scene reader: one function per section of a scene file. Each reads its keys, checks them and refuses
// the ones it does not know. Errors: SceneError.
#pragma once

#include "cases/scene.hpp"
#include "cases/toml_table.hpp"

namespace nilas::cases {

/// [ice] or [[ice]], with `ice.numerics` read before: a periodic axis must be longer than the kernel.
void read_ice(TomlTable& root, sph::IceSpec& ice);

/// [ice.material].
sph::MaterialSpec read_material(TomlTable table);

/// [[body]] and [impact]. `ice` read before. Warnings about masses go to the notes.
std::vector<rigid::BodySpec> read_bodies(TomlTable& root, const sph::IceSpec& ice, std::vector<std::string>& notes);

/// domain and domain_diameter_m of [ice], and cuts the sheet if they say so. The rest of the scene read before.
void read_domain(TomlTable& root, Scene& scene);

/// The mass of a body that no force moves and whose mass is not stated: 1000 kg/m3, without effect on the run.
inline rigid::MassProperties unstated_mass(const rigid::Shape& shape) { return rigid::from_density(shape, 1000); }

}  // namespace nilas::cases
