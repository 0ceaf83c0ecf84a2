// Applies --set to a parsed scene. Part of the TOML reader.
#pragma once

// toml++ 3.3 asserts on a few malformed files ("[ = 1") that it goes on to report properly.
#define TOML_ASSERT(expr) static_cast<void>(0)
#include <toml++/toml.h>

#include <string>

namespace nilas::cases {

/// Sets "dotted.key=value" in the table: array elements by index, missing tables on the way created. The value is TOML;
/// a bare word is a string. Nodes made here have no source file: that is how the reader tells them from the file's.
/// Throws SceneError.
void apply_override(toml::table& root, const std::string& assignment);

/// `text` on one line: control characters become spaces.
std::string one_line(std::string text);

}  // namespace nilas::cases
