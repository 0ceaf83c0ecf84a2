#include "cases/toml_override.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>
#include <vector>

#include "cases/scene.hpp"

namespace nilas::cases {

namespace {

[[noreturn]] void fail(const std::string& assignment, const std::string& reason) {
  throw SceneError(one_line("--set: " + assignment + ": " + reason));
}

bool is_bare_word(const std::string& text) {
  const auto allowed = [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_' || c == '+'; };
  return !text.empty() && std::all_of(text.begin(), text.end(), allowed);
}

/// A table whose only key is "value".
toml::table parse_value(const std::string& assignment, const std::string& text) {
  try {
    toml::table parsed = toml::parse("value = " + text);
    if (parsed.size() == 1) return parsed;  // a line break in the text could bring in further keys
  } catch (const toml::parse_error&) {
    if (is_bare_word(text)) return toml::table{{"value", text}};
  }
  fail(assignment, "allowed: a value in TOML syntax or one bare word");
}

std::vector<std::string> split(const std::string& assignment, const std::string& dotted) {
  std::vector<std::string> names;
  std::istringstream in(dotted + ".");
  for (std::string name; std::getline(in, name, '.');) {
    if (name.empty()) fail(assignment, "allowed: dotted.key=value");
    names.push_back(name);
  }
  return names;
}

std::size_t index_in(const toml::array& array, const std::string& assignment, const std::string& name) {
  std::size_t index = 0;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, index);
  if (error != std::errc() || stop != end || index >= array.size())
    fail(assignment, "\"" + name + "\" stands for an element of an array; allowed: an index from 0 to " +
                         std::to_string(array.size()) + " - 1");
  return index;
}

toml::node& descend(toml::node& node, const std::string& assignment, const std::string& name) {
  if (auto* array = node.as_array()) return *array->get(index_in(*array, assignment, name));
  auto* table = node.as_table();
  if (!table) fail(assignment, "what stands before \"" + name + "\" has no keys");
  if (!table->contains(name)) table->insert_or_assign(name, toml::table{});
  return *table->get(name);
}

}  // namespace

void apply_override(toml::table& root, const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos) fail(assignment, "allowed: dotted.key=value");
  const auto names = split(assignment, assignment.substr(0, equals));
  toml::table parsed = parse_value(assignment, assignment.substr(equals + 1));

  toml::node* parent = &root;
  for (std::size_t i = 0; i + 1 < names.size(); ++i) parent = &descend(*parent, assignment, names[i]);
  const std::string& last = names.back();
  parsed.get("value")->visit([&](auto& value) {
    if (auto* array = parent->as_array())
      array->replace(array->cbegin() + static_cast<std::ptrdiff_t>(index_in(*array, assignment, last)), value);
    else if (auto* table = parent->as_table())
      table->insert_or_assign(last, value);
    else
      fail(assignment, "what stands before \"" + last + "\" has no keys");
  });
}

std::string one_line(std::string text) {
  const auto control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  std::replace_if(text.begin(), text.end(), control, ' ');
  return text;
}

}  // namespace nilas::cases
