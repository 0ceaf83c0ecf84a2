#include "cases/toml_table.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "cases/nearest.hpp"
#include "cases/number_text.hpp"
#include "cases/toml_override.hpp"

namespace nilas::cases {

struct TomlTable::Data {
  std::shared_ptr<const toml::table> document;  // keeps `table` alive
  const toml::table* table;
  std::string path;             // "body.0", empty for the root
  std::string where;            // of the table
  std::set<std::string> known;  // keys asked for
};

namespace {

std::string place(const toml::node& node) {
  const auto& source = node.source();
  return source.path ? *source.path + ":" + std::to_string(source.begin.line) : "--set";
}

std::string value_text(const toml::node& node) {
  if (const auto* number = node.as_floating_point()) return number_text(number->get());
  if (const auto* integer = node.as_integer()) return std::to_string(integer->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (const auto* string = node.as_string()) return "\"" + string->get() + "\"";
  if (node.is_table()) return "{...}";
  const auto* array = node.as_array();
  if (!array) return "(date or time)";
  std::string text;
  for (const auto& element : *array) {
    if (text.size() > 80) return "[" + text + ", ...]";
    text += (text.empty() ? "" : ", ") + value_text(element);
  }
  return "[" + text + "]";
}

/// A number within the range, NaN excluded.
std::optional<double> number_in(const toml::node& node, const Range& range) {
  if (!node.is_number()) return {};
  const double value = *node.value<double>();
  return range.holds(value) ? std::optional(value) : std::nullopt;
}

const std::shared_ptr<const toml::table>& empty_table() {
  static const auto table = std::make_shared<const toml::table>();
  return table;
}

}  // namespace

bool Range::holds(double value) const {
  return std::isfinite(value) && (low_excluded ? value > low : value >= low) &&
         (high_excluded ? value < high : value <= high);
}

std::string Range::text() const {
  std::string text;
  if (std::isfinite(low)) text = (low_excluded ? " > " : " >= ") + number_text(low);
  if (std::isfinite(high))
    text += std::string(text.empty() ? "" : " and") + (high_excluded ? " < " : " <= ") + number_text(high);
  return text;
}

TomlTable TomlTable::open(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  if (!std::filesystem::is_regular_file(file)) throw SceneError(one_line(file.string() + ": no such file"));
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw SceneError(one_line(file.string() + ": cannot be read"));
  try {
    auto document = std::make_shared<toml::table>(toml::parse(text.str(), file.string()));
    for (const auto& assignment : overrides) apply_override(*document, assignment);
    return TomlTable(std::make_shared<Data>(Data{document, document.get(), "", file.string() + ":1", {}}));
  } catch (const toml::parse_error& error) {
    throw SceneError(one_line(file.string() + ":" + std::to_string(error.source().begin.line) +
                              ": not TOML: " + std::string(error.description())));
  }
}

bool TomlTable::has(const std::string& key) {
  data_->known.insert(key);
  return data_->table->contains(key);
}

bool TomlTable::holds_text(const std::string& key) { return has(key) && data_->table->get(key)->is_string(); }

double TomlTable::number(const std::string& key, const Range& range, std::optional<double> fallback) {
  if (!has(key) && fallback) return *fallback;
  const std::string allowed = "allowed: a finite number" + range.text();
  refuse_missing(key, allowed);
  if (const auto value = number_in(*data_->table->get(key), range)) return *value;
  fail(key, allowed);
}

std::vector<double> TomlTable::numbers(const std::string& key, std::size_t count, const Range& range,
                                       const std::optional<std::vector<double>>& fallback) {
  if (!has(key) && fallback) return *fallback;
  const std::string allowed = "allowed: an array of " + std::to_string(count) + " finite numbers" + range.text();
  refuse_missing(key, allowed);
  const auto* array = data_->table->get(key)->as_array();
  if (!array || array->size() != count) fail(key, allowed);
  std::vector<double> values;
  for (const auto& element : *array) {
    const auto value = number_in(element, range);
    if (!value) fail(key, allowed);
    values.push_back(*value);
  }
  return values;
}

Vec3 TomlTable::vector(const std::string& key, const Range& range, const std::optional<Vec3>& fallback) {
  if (!has(key) && fallback) return *fallback;
  const auto values = numbers(key, 3, range);
  return {values[0], values[1], values[2]};
}

bool TomlTable::flag(const std::string& key, bool fallback) {
  if (!has(key)) return fallback;
  const auto* value = data_->table->get(key)->as_boolean();
  if (!value) fail(key, "allowed: true or false");
  return value->get();
}

std::string TomlTable::text(const std::string& key, const std::optional<std::string>& fallback) {
  if (!has(key) && fallback) return *fallback;
  refuse_missing(key, "allowed: a string");
  const auto* value = data_->table->get(key)->as_string();
  if (!value || value->get() != one_line(value->get())) fail(key, "allowed: a string of one line");
  return value->get();
}

std::vector<std::string> TomlTable::texts(const std::string& key) {
  if (!has(key)) return {};
  if (holds_text(key)) return {text(key)};
  const auto* array = data_->table->get(key)->as_array();
  const std::string allowed = "allowed: a string or an array of strings, each of one line";
  if (!array) fail(key, allowed);
  std::vector<std::string> values;
  for (const auto& element : *array) {
    const auto* value = element.as_string();
    if (!value || value->get() != one_line(value->get())) fail(key, allowed);
    values.push_back(value->get());
  }
  return values;
}

std::optional<std::size_t> TomlTable::choice_index(const std::string& key, std::span<const std::string_view> words,
                                                   bool required) {
  if (!has(key) && !required) return {};
  std::string allowed = "allowed:";
  for (const auto word : words)
    allowed += std::string(word == words.front() ? " " : ", ") + "\"" + std::string(word) + "\"";
  refuse_missing(key, allowed);
  const auto* value = data_->table->get(key)->as_string();
  const auto found = value ? std::find(words.begin(), words.end(), value->get()) : words.end();
  if (found == words.end()) fail(key, allowed);
  return static_cast<std::size_t>(found - words.begin());
}

TomlTable TomlTable::table(const std::string& key) {
  if (!has(key))
    return TomlTable(std::make_shared<Data>(Data{empty_table(), empty_table().get(), path(key), data_->where, {}}));
  const auto* child = data_->table->get(key)->as_table();
  if (!child) fail(key, "allowed: a table, [" + path(key) + "]");
  return TomlTable(std::make_shared<Data>(Data{data_->document, child, path(key), place(*child), {}}));
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) {
  std::vector<TomlTable> found;
  if (!has(key)) return found;
  const auto* array = data_->table->get(key)->as_array();
  if (!array || !array->is_array_of_tables()) fail(key, "allowed: an array of tables, [[" + path(key) + "]]");
  for (const auto& element : *array) {
    const std::string name = path(key) + "." + std::to_string(found.size());
    found.push_back(
        TomlTable(std::make_shared<Data>(Data{data_->document, element.as_table(), name, place(element), {}})));
  }
  return found;
}

std::vector<TomlTable> TomlTable::table_or_tables(const std::string& key) {
  if (has(key) && data_->table->get(key)->is_table()) return {table(key)};
  return tables(key);
}

void TomlTable::refuse_unknown_keys() const {
  for (const auto& [key, node] : *data_->table) {
    const std::string name(key.str());
    if (data_->known.contains(name)) continue;
    fail(name, "unknown key, the nearest known one is " + nearest(name, {data_->known.begin(), data_->known.end()}));
  }
}

void TomlTable::refuse(const std::string& key, const std::string& reason) {
  if (has(key)) fail(key, reason);
}

void TomlTable::fail(const std::string& key, const std::string& reason) const {
  const toml::node* node = data_->table->get(key);
  const std::string value = node ? " = " + value_text(*node) : " (not given)";
  throw SceneError(one_line(where(key) + ": " + path(key) + value + ": " + reason));
}

/// A missing key is often a mistyped one: then the typing error is what the user wants to hear of.
void TomlTable::refuse_missing(const std::string& key, const std::string& allowed) const {
  if (data_->table->contains(key)) return;
  for (const auto& [other, node] : *data_->table) {
    const std::string name(other.str());
    if (!data_->known.contains(name) && edit_distance(name, key) <= 2)
      fail(name, "unknown key, the nearest known one is " + key);
  }
  fail(key, "needed; " + allowed);
}

std::string TomlTable::where(const std::string& key) const {
  const toml::node* node = data_->table->get(key);
  return node ? place(*node) : data_->where;
}

std::string TomlTable::path(const std::string& key) const {
  return data_->path.empty() ? key : data_->path + "." + key;
}

}  // namespace nilas::cases
