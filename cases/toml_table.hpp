// A strict reader of TOML tables. It knows file and line of every value and which keys were asked for, so that a key
// nobody asked for is an error. The only place that knows toml++.
#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cases/scene.hpp"

namespace nilas::cases {

/// The finite numbers that a key may have.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_excluded = false;
  bool high_excluded = false;

  bool holds(double value) const;
  std::string text() const;  // " >= 0 and < 0.5"; empty without bounds
};
inline constexpr Range any_number{};
inline constexpr Range positive{.low = 0, .low_excluded = true};
inline constexpr Range not_negative{.low = 0};

/// A word of the scene language and the value it stands for.
template <class Value>
struct Word {
  std::string_view word;
  Value value;
};

/// One table of a scene: a handle, copies share what they have asked for.
///
/// Every getter marks its key as known. All errors are SceneErrors of one line, "file:line: key = value: what is
/// allowed"; the line of a value given by --set is "--set". A getter without a fallback refuses a missing key.
class TomlTable {
 public:
  /// The root table of a file, with "dotted.key=value" overrides applied to it. Errors: no such file, TOML syntax.
  static TomlTable open(const std::filesystem::path& file, const std::vector<std::string>& overrides);

  bool has(const std::string& key);
  bool holds_text(const std::string& key);

  double number(const std::string& key, const Range& range, std::optional<double> fallback = {});
  /// `count` numbers, each within the range.
  std::vector<double> numbers(const std::string& key, std::size_t count, const Range& range,
                              const std::optional<std::vector<double>>& fallback = {});
  Vec3 vector(const std::string& key, const Range& range, const std::optional<Vec3>& fallback = {});
  bool flag(const std::string& key, bool fallback);
  std::string text(const std::string& key, const std::optional<std::string>& fallback = {});
  /// A string or an array of strings; empty if missing.
  std::vector<std::string> texts(const std::string& key);
  /// The value of one of the words.
  template <class Value, std::size_t n>
  Value choice(const std::string& key, const Word<Value> (&words)[n], std::optional<Value> fallback = {});

  /// A table; an empty one if missing.
  TomlTable table(const std::string& key);
  /// The tables of [[key]]; none if missing.
  std::vector<TomlTable> tables(const std::string& key);
  /// As `tables`, and one for [key].
  std::vector<TomlTable> table_or_tables(const std::string& key);

  /// Throws if a key is there that no one asked for, naming the nearest known key.
  void refuse_unknown_keys() const;
  /// Throws with the reason if the key is there: it is known but has no place here.
  void refuse(const std::string& key, const std::string& reason);
  /// Throws "file:line: key = value: reason".
  [[noreturn]] void fail(const std::string& key, const std::string& reason) const;

  /// "file:line" of a key, of the table if the key is missing.
  std::string where(const std::string& key) const;

 private:
  struct Data;
  explicit TomlTable(std::shared_ptr<Data> data) : data_(std::move(data)) {}
  std::optional<std::size_t> choice_index(const std::string& key, std::span<const std::string_view> words,
                                          bool required);
  std::string path(const std::string& key) const;
  void refuse_missing(const std::string& key, const std::string& allowed) const;

  std::shared_ptr<Data> data_;
};

template <class Value, std::size_t n>
Value TomlTable::choice(const std::string& key, const Word<Value> (&words)[n], std::optional<Value> fallback) {
  std::string_view names[n];
  for (std::size_t i = 0; i < n; ++i) names[i] = words[i].word;
  const auto index = choice_index(key, names, !fallback);
  return index ? words[*index].value : *fallback;
}

}  // namespace nilas::cases
