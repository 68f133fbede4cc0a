#include "server/cli/shown.h"

#include <array>
#include <cstdio>
#include <utility>

namespace snapthrough::server::cli {
namespace {

unsigned byte_at(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

/// Returns the length of the UTF-8 sequence that a byte begins; 0 for a byte that begins none.
std::size_t length_of(unsigned lead) {
  if (lead < 0x80) {
    return 1;
  }
  if (lead >= 0xc2 && lead < 0xe0) {
    return 2;
  }
  if (lead >= 0xe0 && lead < 0xf0) {
    return 3;
  }
  return lead >= 0xf0 && lead < 0xf5 ? 4 : 0;
}

/// Returns how many bytes at the begin of a text are one character of UTF-8; 0: none.
std::size_t character(std::string_view text) {
  const std::size_t length = length_of(byte_at(text, 0));
  if (length > text.size()) {
    return 0;
  }
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte_at(text, i) & 0xc0U) != 0x80) {
      return 0;
    }
  }
  // Longer forms of characters that have a shorter one are none: they could hide a control character.
  const bool overlong = (byte_at(text, 0) == 0xe0 && byte_at(text, 1) < 0xa0) ||
                        (byte_at(text, 0) == 0xf0 && byte_at(text, 1) < 0x90);
  return overlong ? 0 : length;
}

/// Returns whether the character of `length` bytes at the begin of a text is a control character.
bool is_control(std::string_view text, std::size_t length) {
  const unsigned first = byte_at(text, 0);
  if (length == 1) {
    return (first < 0x20 && first != '\n' && first != '\t') || first == 0x7f;
  }
  return length == 2 && first == 0xc2 && byte_at(text, 1) < 0xa0;
}

/// Returns how many bytes at the end of a text are the begin of a character that goes on.
std::size_t begun_at_end(std::string_view text) {
  for (std::size_t back = 1; back <= 3 && back <= text.size(); ++back) {
    const unsigned byte = byte_at(text, text.size() - back);
    if ((byte & 0xc0U) != 0x80) {
      return length_of(byte) > back ? back : 0;
    }
  }
  return 0;
}

void append_code(std::string& text, unsigned code) {
  std::array<char, 8> escape{};
  std::snprintf(escape.data(), escape.size(), "\\u%04x", code);
  text += escape.data();
}

void write_raw(std::ostream& out, std::string_view text) {
  if (auto* const buffer = dynamic_cast<ShownBuffer*>(out.rdbuf())) {
    buffer->pass(text);
  } else {
    out << text;
  }
}

}  // namespace

std::string shown(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = character(text);
    if (length == 0 || is_control(text, length)) {
      append_code(safe, byte_at(text, length == 2 ? 1 : 0));
    } else {
      safe += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return safe;
}

void ShownBuffer::pass(std::string_view text) {
  to_->sputn(text.data(), static_cast<std::streamsize>(text.size()));
}

std::streamsize ShownBuffer::xsputn(const char* text, std::streamsize count) {
  std::string all = std::move(begun_);
  all.append(text, static_cast<std::size_t>(count));
  const std::size_t whole = all.size() - begun_at_end(all);
  begun_ = all.substr(whole);
  const std::string safe = shown(std::string_view(all).substr(0, whole));
  const auto size = static_cast<std::streamsize>(safe.size());
  return to_->sputn(safe.data(), size) == size ? count : 0;
}

int ShownBuffer::overflow(int letter) {
  if (traits_type::eq_int_type(letter, traits_type::eof())) {
    return traits_type::not_eof(letter);
  }
  const char one = traits_type::to_char_type(letter);
  return xsputn(&one, 1) == 1 ? letter : traits_type::eof();
}

int ShownBuffer::sync() {
  pass(shown(std::exchange(begun_, {})));
  return to_->pubsync();
}

std::ostream& line_start(std::ostream& out) {
  write_raw(out, "\r");
  return out;
}

std::ostream& line_end(std::ostream& out) {
  write_raw(out, "\x1b[K");
  return out;
}

}  // namespace snapthrough::server::cli
