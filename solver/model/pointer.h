#pragma once
/// @file
/// JSON Pointers (RFC 6901), the places of findings.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace snapthrough {

/// Token of a pointer with `~` and `/` escaped as `~0` and `~1`.
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

/// @brief Pointer that grows by tokens and is converted to text on demand, because few places are reported.
/// Keys are kept by reference.
class PointerPath {
 public:
  explicit PointerPath(std::string prefix = {}) : prefix_(std::move(prefix)) {}

  [[nodiscard]] PointerPath with(std::string_view key) const { return with({key, 0, false}); }
  [[nodiscard]] PointerPath with(std::size_t index) const { return with({{}, index, true}); }
  [[nodiscard]] std::string text() const {
    std::string all = prefix_;
    for (std::size_t i = 0; i < size_; ++i) {
      all += "/";
      all += tokens_[i].is_index ? std::to_string(tokens_[i].index) : escape_pointer_token(tokens_[i].key);
    }
    return all;
  }

 private:
  struct Token {
    std::string_view key;
    std::size_t index = 0;
    bool is_index = false;
  };
  [[nodiscard]] PointerPath with(const Token& token) const {
    PointerPath longer = size_ < tokens_.size() ? *this : PointerPath(text());
    longer.tokens_[longer.size_++] = token;
    return longer;
  }

  std::string prefix_;  ///< given prefix, and tokens beyond the fixed number
  std::array<Token, 8> tokens_{};
  std::size_t size_ = 0;
};

}  // namespace snapthrough
