#pragma once
/// @file
/// Destination of what `fetch` gets from a service.

#include <cstdint>
#include <cstdio>
#include <iosfwd>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "server/cli/remote_service.h"

namespace snapthrough::server::cli {

/// @brief A result or table on its way to a file or to standard output: it comes in pieces, is not held in
/// memory, and is where it belongs when it is complete.
///
/// The pieces go to a file beside the named one, which gets its name in keep(), or else to an unnamed one in
/// the folder for temporary files (TMPDIR, /tmp), which keep() copies.
class Output final : public BodySink {
 public:
  /// @param path file to write; empty: `out`, which outlives the object
  Output(std::string path, std::ostream& out);
  ~Output() override;
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  Output(Output&&) = delete;
  Output& operator=(Output&&) = delete;

  /// A body begins at the end of what complete() has settled; the rest of an earlier attempt is removed.
  void begin() override;
  bool write(std::string_view piece) override;
  /// Settles what was written. @param skip_line whether the first line of the next body is left out, because
  /// it is the head of the table again
  void complete(bool skip_line) {
    settled_ = size_;
    skips_line_ = skip_line;
  }

  /// Returns a member of the JSON object that was written; null when there is none. The others are not held
  /// in memory.
  [[nodiscard]] nlohmann::json member(const std::string& name) const;
  /// Completes the output; call it after the last write(). @return whether all was written
  [[nodiscard]] bool keep();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  [[nodiscard]] std::string part() const { return path_ + ".part"; }
  bool copy_to(std::ostream& out) const;

  const std::string path_;
  const bool has_part_;  ///< the pieces are in a file beside the named one
  std::ostream& out_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t size_ = 0;
  std::uint64_t settled_ = 0;
  bool skips_line_ = false;
  bool in_skipped_line_ = false;
  bool is_whole_;  ///< no write has failed
};

}  // namespace snapthrough::server::cli
