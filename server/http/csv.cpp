#include "server/http/csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

#include "api/csv_field.h"

namespace snapthrough::server::http {
namespace {

constexpr const char* kLineEnd = "\r\n";

void append(std::string& text, double value) {
  std::array<char, 40> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), end);
}

/// The ids of all branches, each once, in the order they come.
std::vector<std::string> ids_of(const StoredPath& path, std::vector<NamedSeries> Branch::*series) {
  std::vector<std::string> ids;
  for (const Branch& branch : path.branches) {
    for (const NamedSeries& one : branch.*series) {
      if (std::find(ids.begin(), ids.end(), one.id) == ids.end()) {
        ids.push_back(one.id);
      }
    }
  }
  return ids;
}

void append_value(std::string& text, const std::vector<NamedSeries>& series, const std::string& id,
                  std::size_t point) {
  text += ',';
  const auto found =
      std::find_if(series.begin(), series.end(), [&](const NamedSeries& one) { return one.id == id; });
  if (found != series.end() && point < found->values.size()) {
    append(text, found->values[point]);
  }
}

}  // namespace

std::string path_csv(const StoredPath& path) {
  const std::vector<std::string> monitors = ids_of(path, &Branch::monitors);
  const std::vector<std::string> bases = ids_of(path, &Branch::contact_fraction);
  std::string text = "branch,point,load_factor,arc_length,negative_eigenvalues";
  for (const std::string& id : monitors) {
    api::append_csv_field(text += ',', id);
  }
  for (const std::string& id : bases) {
    api::append_csv_field(text += ',', "contact_fraction:" + id);
  }
  text += kLineEnd;
  for (const Branch& branch : path.branches) {
    for (std::size_t point = 0; point < branch.load_factor.size(); ++point) {
      text += std::to_string(branch.id) + "," + std::to_string(point) + ",";
      append(text, branch.load_factor[point]);
      append(text += ',', branch.arc_length[point]);
      text += "," + std::to_string(branch.negative_eigenvalues[point]);
      for (const std::string& id : monitors) {
        append_value(text, branch.monitors, id, point);
      }
      for (const std::string& id : bases) {
        append_value(text, branch.contact_fraction, id, point);
      }
      text += kLineEnd;
    }
  }
  return text;
}

}  // namespace snapthrough::server::http
