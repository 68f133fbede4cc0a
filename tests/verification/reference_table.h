#pragma once
/// @file
/// Reads the tables of tests/verification/data: a comment line that gives definition and source, a header
/// line, rows.

#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace snapthrough::testing {

/// One row of a table; columns by name.
class TableRow {
 public:
  TableRow(const std::vector<std::string>& header, std::vector<std::string> cells)
      : header_(&header), cells_(std::move(cells)) {}

  [[nodiscard]] const std::string& text(const std::string& column) const {
    for (std::size_t i = 0; i < header_->size(); ++i)
      if ((*header_)[i] == column) return cells_.at(i);
    throw std::out_of_range("no column " + column);
  }
  [[nodiscard]] bool has(const std::string& column) const { return !text(column).empty(); }
  /// The number in a column, "inf" included; throws when the cell holds anything else.
  [[nodiscard]] double number(const std::string& column) const {
    const std::string& cell = text(column);
    if (cell == "inf") return std::numeric_limits<double>::infinity();
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size())
      throw std::invalid_argument(column + " is not a number: '" + cell + "'");
    return value;
  }

 private:
  const std::vector<std::string>* header_;
  std::vector<std::string> cells_;
};

/// A whole table. Its rows refer to its header: keep it while they are used.
class Table {
 public:
  explicit Table(const std::string& file) {
    const std::string path = SNAPTHROUGH_SOURCE_DIR "/tests/verification/data/" + file;
    std::ifstream in(path);
    if (!in) throw std::runtime_error("can't open " + path);
    for (std::string line; std::getline(in, line);) {
      if (line.empty() || line.front() == '#') continue;
      if (header_.empty()) {
        header_ = split(line);
      } else {
        rows_.push_back(fitted(split(line)));
      }
    }
  }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;
  ~Table() = default;

  [[nodiscard]] std::vector<TableRow> rows() const {
    std::vector<TableRow> out;
    for (const auto& cells : rows_) out.emplace_back(header_, cells);
    return out;
  }

 private:
  static std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells(1);
    for (const char c : line) {
      if (c == ',')
        cells.emplace_back();
      else if (c != '\r')
        cells.back() += c;
    }
    return cells;
  }
  /// Commas in the words of the first column are joined again.
  [[nodiscard]] std::vector<std::string> fitted(std::vector<std::string> cells) const {
    while (cells.size() > header_.size()) {
      cells[0] += "," + cells[1];
      cells.erase(cells.begin() + 1);
    }
    return cells;
  }

  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace snapthrough::testing
