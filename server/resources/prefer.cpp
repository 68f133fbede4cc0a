#include "server/resources/prefer.h"

#include <charconv>

namespace snapthrough::server::http {
namespace {

void read_preference(std::string_view text, Preferences& preferences) {
  text = trimmed(text.substr(0, text.find(';')));  // parameters of a preference mean nothing here
  const std::size_t equals = text.find('=');
  const std::string_view name = trimmed(text.substr(0, equals));
  if (equal_ignoring_case(name, "respond-async")) {
    preferences.respond_async = true;
  }
  if (!equal_ignoring_case(name, "wait") || equals == std::string_view::npos || preferences.wait_s) {
    return;  // the first of several counts
  }
  const std::string_view value = trimmed(text.substr(equals + 1));
  int seconds = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), seconds);
  if (error == std::errc() && end == value.data() + value.size() && seconds >= 0) {
    preferences.wait_s = seconds;
  }
}

}  // namespace

Preferences read_preferences(const Request& request) {
  Preferences preferences;
  for (const auto& [name, value] : request.headers) {
    if (!equal_ignoring_case(name, "Prefer")) {
      continue;
    }
    for (const std::string_view part : split_list(value, ',')) {
      read_preference(part, preferences);
    }
  }
  return preferences;
}

}  // namespace snapthrough::server::http
