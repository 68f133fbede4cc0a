#pragma once
/// @file
/// The web page: its files at "/" and "/assets/NAME", built in or from a folder, and its documents at
/// "/docs/NAME", built in.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/resources/message.h"

namespace snapthrough::server::http {

/// A file of web/dist or docs in the program; the build generates its definition.
struct PageFile {
  std::string_view path;                  ///< path in a request: "/", "/assets/app-1A2B3C4D.js"
  std::string_view digest;                ///< SHA-256 of the content, hexadecimal
  std::span<const unsigned char> packed;  ///< content in gzip format
};

[[nodiscard]] const std::vector<PageFile>& embedded_page();

/// A document of docs/ with its tables of fields.
struct FieldsDocument {
  std::string_view path;  ///< in a request: "/docs/results.md"
  std::string text;
  std::string etag;
};
/// @brief The documents that have a table of fields, which docs/ has the place of
/// (api/openapi/field_table.h). Thread-safe.
[[nodiscard]] const std::vector<FieldsDocument>& fields_documents();

/// Sources of the page other than a folder.
inline constexpr std::string_view kEmbeddedPage = "built-in";
inline constexpr std::string_view kNoPage = "none";

/// Returns whether only files of the page can have a path. They contain no jobs and are equal for all
/// clients, so they need no key.
[[nodiscard]] bool is_page_path(std::string_view path);

/// @brief Serves the files of the page. Thread-safe.
class Page {
 public:
  Page() : source_(kNoPage) {}
  /// @param source kEmbeddedPage, kNoPage, or a folder like web/dist, which is read at every request
  explicit Page(std::string source) : source_(std::move(source)) {}

  /// Returns the response to a GET or HEAD; nullopt when the page has no such file.
  [[nodiscard]] std::optional<Response> respond(const Request& request) const;

 private:
  std::string source_;
};

}  // namespace snapthrough::server::http
