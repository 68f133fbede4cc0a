#include "server/cli/input.h"

#include <fstream>
#include <istream>
#include <iterator>
#include <ostream>

namespace snapthrough::server::cli {

std::optional<std::string> read_all(const std::string& path, const Streams& streams) {
  if (path == "-") {
    return std::string(std::istreambuf_iterator<char>(streams.in), {});
  }
  std::ifstream file(path, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file) {
    streams.err << "snapthrough: cannot read " << path << '\n';
    return std::nullopt;
  }
  return text;
}

void print_findings(const std::vector<Finding>& findings, const Streams& streams) {
  for (const Finding& finding : findings) {
    streams.err << finding.pointer << ": " << finding.detail << " [" << finding.code << "]\n";
  }
}

}  // namespace snapthrough::server::cli
