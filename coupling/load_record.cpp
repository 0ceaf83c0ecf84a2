#include "coupling/load_record.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace nilas {

namespace {

constexpr std::array<std::string_view, 7> kColumns = {
    "time_s",
    "impulse_x_N_s",
    "impulse_y_N_s",
    "impulse_z_N_s",
    "angular_impulse_x_N_m_s",
    "angular_impulse_y_N_m_s",
    "angular_impulse_z_N_m_s",
};

std::string header() {
  std::string line(kColumns[0]);
  for (std::size_t k = 1; k < kColumns.size(); ++k) line.append(",").append(kColumns[k]);
  return line;
}

/// The shortest decimal that reads back as the same double.
void append_number(std::string& line, double value) {
  char text[32];
  line.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

std::string line_of(const LoadRow& row) {
  std::string line;
  append_number(line, row.time);
  for (const Vec3& v : {row.impulse, row.angular_impulse})
    for (const double component : v) {
      line += ',';
      append_number(line, component);
    }
  return line;
}

/// refuse: throws, with the place and what is said.
template <class Refuse>
LoadRow row_in(std::string_view line, const Refuse& refuse) {
  std::array<double, kColumns.size()> n;
  for (std::size_t k = 0; k < kColumns.size(); ++k) {
    const bool last = k + 1 == kColumns.size();
    const std::size_t comma = line.find(',');
    if ((comma == std::string_view::npos) != last)
      refuse("must have " + std::to_string(kColumns.size()) + " columns: " + header());
    const std::string_view cell = line.substr(0, comma);
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), n[k]);
    if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(n[k]))
      refuse(std::string(kColumns[k]) + " is \"" + std::string(cell) + "\", must be a finite number");
    if (!last) line.remove_prefix(comma + 1);
  }
  return {n[0], Vec3(n[1], n[2], n[3]), Vec3(n[4], n[5], n[6])};
}

/// Why `row` cannot follow `rows`; empty if it can.
std::string fault(const std::vector<LoadRow>& rows, const LoadRow& row) {
  if (!std::isfinite(row.time) || !row.impulse.allFinite() || !row.angular_impulse.allFinite())
    return "a number is not finite";
  if (!rows.empty() && row.time <= rows.back().time) return "time_s is not after that of the row before";
  return {};
}

}  // namespace

LoadRecord::LoadRecord(double interval) : interval_(interval), rows_(1) {}

LoadRecord::LoadRecord(std::vector<LoadRow> rows) {
  if (rows.empty()) throw std::invalid_argument("LoadRecord: no row, must have at least one");
  for (const LoadRow& row : rows) {
    const std::string what = fault(rows_, row);
    if (!what.empty()) throw std::invalid_argument("LoadRecord: row " + std::to_string(rows_.size()) + ": " + what);
    rows_.push_back(row);
  }
}

void LoadRecord::add(double time, const BodyAccount& account) {
  const LoadRow row{time, account.ice_impulse, account.ice_angular_impulse};
  const std::size_t n = rows_.size();
  const bool due = n < 2 || rows_[n - 1].time - rows_[n - 2].time >= interval_ * (1 - 1e-12);
  if (!due) rows_.pop_back();
  rows_.push_back(row);
}

void write_load_record(const LoadRecord& record, const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::binary);
  out << header() << '\n';
  for (const LoadRow& row : record.rows()) out << line_of(row) << '\n';
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot write: " + std::strerror(errno));
}

LoadRecord read_load_record(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(file.string() + ": cannot read: " + std::strerror(errno));
  std::size_t number = 1;
  const auto refuse = [&](const std::string& what) {
    throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": " + what);
  };
  const auto next_line = [&](std::string& line) {
    if (!std::getline(in, line)) return false;
    if (line.ends_with('\r')) line.pop_back();
    return true;
  };
  std::string line;
  if (!next_line(line) || line != header()) refuse("the first line must be " + header());
  std::vector<LoadRow> rows;
  while (++number, next_line(line)) {
    const LoadRow row = row_in(line, refuse);
    const std::string what = fault(rows, row);
    if (!what.empty()) refuse(what);
    rows.push_back(row);
  }
  if (rows.empty()) refuse("no row, must have at least one");
  return LoadRecord(std::move(rows));
}

}  // namespace nilas
