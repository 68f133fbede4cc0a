#pragma once
/// @file
/// Texts of others on a terminal: control characters, which command it, are shown and not obeyed.

#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace snapthrough::server::cli {

/// @brief Returns the text with each control character, and each byte that is no UTF-8, as \u00XX. Control
/// characters are those below 0x20 but newline and tab, 0x7f, and U+0080 to U+009f.
[[nodiscard]] std::string shown(std::string_view text);

/// Passes texts on to another buffer as shown() returns them.
class ShownBuffer final : public std::streambuf {
 public:
  explicit ShownBuffer(std::streambuf* to) : to_(to) {}
  /// Passes a text on as it is.
  void pass(std::string_view text);

 protected:
  std::streamsize xsputn(const char* text, std::streamsize count) override;
  int overflow(int letter) override;
  int sync() override;

 private:
  std::streambuf* to_;
  std::string begun_;  ///< first bytes of a character whose others have not come yet
};

/// A stream whose texts, of whatever origin, leave a terminal alone.
class ShownStream final : public std::ostream {
 public:
  /// @param to outlives the stream
  explicit ShownStream(std::ostream& to) : std::ostream(nullptr), buffer_(to.rdbuf()) {
    rdbuf(&buffer_);
    setf(to.flags() & std::ios_base::unitbuf);
  }

 private:
  ShownBuffer buffer_;
};

/// Moves the cursor of a terminal to the begin of its line, for progress: `err << line_start << text`.
std::ostream& line_start(std::ostream& out);
/// Erases the rest of a terminal's line.
std::ostream& line_end(std::ostream& out);

}  // namespace snapthrough::server::cli
