// The words of the scene language, shared by reader and writer.
#pragma once

#include "cases/scene.hpp"
#include "cases/toml_table.hpp"

namespace nilas::cases::words {

inline constexpr Word<sph::IceShape> ice_shape[] = {
    {"disc", sph::IceShape::disc}, {"block", sph::IceShape::block}, {"sphere", sph::IceShape::sphere}};

inline constexpr Word<sph::Model> model[] = {{"elastic", sph::Model::elastic},
                                             {"neo-hookean", sph::Model::neo_hookean},
                                             {"drucker-prager", sph::Model::drucker_prager},
                                             {"rate-dependent", sph::Model::rate_dependent}};

inline constexpr Word<sph::PressureLaw> pressure[] = {{"volumetric-strain", sph::PressureLaw::volumetric_strain},
                                                      {"density", sph::PressureLaw::density}};

inline constexpr Word<sph::AfterFailure> after_failure[] = {{"plastic", sph::AfterFailure::plastic},
                                                            {"cohesionless", sph::AfterFailure::cohesionless},
                                                            {"fluid", sph::AfterFailure::fluid},
                                                            {"softening", sph::AfterFailure::softening}};

inline constexpr Word<sph::SoundSpeed> sound_speed[] = {{"bulk", sph::SoundSpeed::bulk},
                                                        {"p-wave", sph::SoundSpeed::p_wave}};

inline constexpr Word<sph::Precision> precision[] = {{"double", sph::Precision::double_},
                                                     {"single", sph::Precision::single}};

inline constexpr Word<rigid::Motion> motion[] = {{"free", rigid::Motion::free},
                                                 {"translation-only", rigid::Motion::translation_only},
                                                 {"fixed-path", rigid::Motion::fixed_path},
                                                 {"fixed", rigid::Motion::fixed}};

/// Whether the sheet is cut where its far field does not matter.
inline constexpr Word<bool> domain[] = {{"full", false}, {"auto", true}};

/// In the order of sph::FixedParts::faces.
inline constexpr std::string_view face[] = {"x-", "x+", "y-", "y+", "z-", "z+"};
inline constexpr std::string_view axis[] = {"x", "y", "z"};

/// The word of a value; every value of the enumerations above has one.
template <class Value, std::size_t n>
constexpr std::string_view word_of(const Word<Value> (&words)[n], Value value) {
  for (const auto& entry : words)
    if (entry.value == value) return entry.word;
  return {};
}

}  // namespace nilas::cases::words
