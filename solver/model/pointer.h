#pragma once
/// @file
/// JSON Pointers (RFC 6901), as text: how a finding says where it stands.

#include <string>
#include <string_view>

namespace snapthrough {

/// One token of a pointer with `~` and `/` escaped as `~0` and `~1`.
[[nodiscard]] inline std::string escape_pointer_token(std::string_view token) {
  std::string escaped;
  escaped.reserve(token.size());
  for (const char c : token) {
    if (c == '~') {
      escaped += "~0";
    } else if (c == '/') {
      escaped += "~1";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

}  // namespace snapthrough
