#include "server/resources/prefer.h"

#include <charconv>

namespace snapthrough::server::http {
namespace {

std::optional<ReturnPreference> return_shape(std::string_view value) {
  if (equal_ignoring_case(value, "minimal")) {
    return ReturnPreference::minimal;
  }
  return equal_ignoring_case(value, "representation") ? std::optional(ReturnPreference::representation)
                                                      : std::nullopt;
}

void read_preference(std::string_view text, Preferences& preferences) {
  text = trimmed(text.substr(0, text.find(';')));  // ignores parameters of the preference
  const std::size_t equals = text.find('=');
  const std::string_view name = trimmed(text.substr(0, equals));
  if (equal_ignoring_case(name, "respond-async")) {
    preferences.respond_async = true;
  }
  if (equals == std::string_view::npos) {
    return;
  }
  std::string_view value = trimmed(text.substr(equals + 1));
  if (value.size() >= 2 && value.front() == '"' && value.back() == '"') {
    value = value.substr(1, value.size() - 2);
  }
  if (equal_ignoring_case(name, "return") && !preferences.return_shape) {
    preferences.return_shape = return_shape(value);
  }
  if (!equal_ignoring_case(name, "wait") || preferences.wait_s) {
    return;
  }
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
