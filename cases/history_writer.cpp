#include <fmt/format.h>

#include <cassert>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "cases/results.hpp"

namespace nilas::cases {

struct HistoryWriter::Impl {
  std::string path;
  std::vector<std::string> columns;
  std::ofstream out;
  std::size_t rows = 0;

  void write_line(const std::string& line);
};

void HistoryWriter::Impl::write_line(const std::string& line) {
  out << line << '\n' << std::flush;
  if (!out) throw std::runtime_error(path + ": cannot write: " + std::strerror(errno));
}

HistoryWriter::HistoryWriter(const std::filesystem::path& file, const std::vector<std::string>& columns)
    : impl_(new Impl{file.string(), columns, std::ofstream(file, std::ios::binary)}) {
  impl_->write_line(fmt::format("{}", fmt::join(columns, ",")));
}

HistoryWriter::~HistoryWriter() = default;

void HistoryWriter::append(const std::vector<double>& row) {
  assert(row.size() == impl_->columns.size());
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (std::isfinite(row[i])) continue;
    throw std::runtime_error(fmt::format("{}: {} is {} in row {}: the row is not written", impl_->path,
                                         impl_->columns[i], row[i], impl_->rows));
  }
  // fmt's default is the shortest text that reads back to the same number.
  impl_->write_line(fmt::format("{}", fmt::join(row, ",")));
  ++impl_->rows;
}

}  // namespace nilas::cases
