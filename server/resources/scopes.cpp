#include "server/resources/scopes.h"

#include <algorithm>
#include <array>
#include <utility>

namespace snapthrough::server::http {
namespace {

constexpr std::array kNames{std::pair{Scope::read, std::string_view("read")},
                            std::pair{Scope::submit, std::string_view("submit")},
                            std::pair{Scope::metrics, std::string_view("metrics")}};

/// Paths of a POST that computes without storing anything: who reads may ask, and who submits must be able to
/// look at a document first.
constexpr std::array<std::string_view, 3> kComputed{"/v1/check", "/v1/convert", "/v1/plot"};

}  // namespace

std::optional<Scope> scope_from(std::string_view name) {
  const auto* found =
      std::find_if(kNames.begin(), kNames.end(), [&](const auto& one) { return one.second == name; });
  return found == kNames.end() ? std::nullopt : std::optional(found->first);
}

std::string names_of(Scopes scopes, std::string_view between) {
  std::string text;
  for (const auto& [scope, name] : kNames) {
    if (scopes.has(scope)) {
      text.append(text.empty() ? "" : between).append(name);
    }
  }
  return text;
}

Scopes scopes_for(std::string_view method, std::string_view path) {
  if (path == "/metrics") {
    return {Scope::metrics};
  }
  if (method == "GET" || method == "HEAD") {
    return {Scope::read};
  }
  const bool computed = std::find(kComputed.begin(), kComputed.end(), path) != kComputed.end();
  return computed ? Scopes{Scope::read, Scope::submit} : Scopes{Scope::submit};
}

}  // namespace snapthrough::server::http
