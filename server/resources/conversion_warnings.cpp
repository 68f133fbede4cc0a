#include "server/resources/conversion_warnings.h"

#include <nlohmann/json.hpp>
#include <string>

namespace snapthrough::server::http {

namespace {

/// Returns the text with "some_option" for each "--some-option". The text has nothing of the drawing but
/// numbers.
std::string with_parameters(const std::string& text) {
  std::string named;
  bool in_option = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "--") == 0) {
      in_option = true;
      ++i;
      continue;
    }
    in_option = in_option && ((text[i] >= 'a' && text[i] <= 'z') || text[i] == '-');
    named += in_option && text[i] == '-' ? '_' : text[i];
  }
  return named;
}

}  // namespace

nlohmann::json conversion_warnings(const std::vector<Warning>& warnings) {
  nlohmann::json list = nlohmann::json::array();
  for (const Warning& warning : warnings) {
    list.push_back({{"code", warning.code}, {"detail", with_parameters(warning.detail)}});
  }
  return list;
}

}  // namespace snapthrough::server::http
