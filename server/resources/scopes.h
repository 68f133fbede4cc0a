#pragma once
/// @file
/// What a key permits, and what each operation of the interface asks for.

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace snapthrough::server::http {

/// A right that a key may have.
enum class Scope : unsigned {
  read = 1,    ///< to read jobs, sweeps and what the service says about itself
  submit = 2,  ///< to hand in, stop and remove jobs and sweeps
  metrics = 4  ///< to read /metrics
};

/// A set of scopes.
class Scopes {
 public:
  constexpr Scopes() = default;
  constexpr Scopes(std::initializer_list<Scope> scopes) {
    for (const Scope scope : scopes) {
      add(scope);
    }
  }
  [[nodiscard]] static constexpr Scopes all() { return {Scope::read, Scope::submit, Scope::metrics}; }

  constexpr void add(Scope scope) { bits_ |= static_cast<unsigned>(scope); }
  [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
  [[nodiscard]] constexpr bool has(Scope scope) const { return (bits_ & static_cast<unsigned>(scope)) != 0; }
  /// Returns whether the two sets have a scope in common.
  [[nodiscard]] constexpr bool meets(Scopes other) const { return (bits_ & other.bits_) != 0; }
  [[nodiscard]] constexpr bool operator==(const Scopes&) const = default;

 private:
  unsigned bits_ = 0;
};

/// Returns the scope of a name ("read", "submit", "metrics"); nullopt for another text.
[[nodiscard]] std::optional<Scope> scope_from(std::string_view name);

/// Returns the names of scopes with a text between them, such as "read or submit".
[[nodiscard]] std::string names_of(Scopes scopes, std::string_view between);

/// @brief Returns the scopes of which a key needs one for a request. A path without a resource has those that
/// its method would have. Requests that need no key are not told apart.
[[nodiscard]] Scopes scopes_for(std::string_view method, std::string_view path);

}  // namespace snapthrough::server::http
