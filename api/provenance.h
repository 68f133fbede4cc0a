#pragma once
/// @file
/// What made an answer: the program, and the request as a digest.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace snapthrough::api {

/// The program that computes.
struct Program {
  std::string_view name;     ///< "snapthrough"
  std::string_view version;  ///< e.g. "0.1.0"
  /// The commit of the sources, e.g. "48133bea0c1d", with "+" behind it where files differed from it;
  /// "unknown" for sources without a repository, unless the build was given SNAPTHROUGH_BUILD.
  std::string_view build;
  std::string_view target;  ///< processor, system, instruction set, e.g. "x86_64-linux x86-64-v3"
};

[[nodiscard]] const Program& this_program();

/// Returns `{"name", "version", "build", "target"}` of this program.
[[nodiscard]] nlohmann::json program_json();

/// Returns program_json() as text.
[[nodiscard]] const std::string& program_text();

/// @brief Returns the members of a JSON object that tell what made a document: `kind`, `program`,
/// `request_sha256`.
/// @param program program_text(), or "" where it is not known: null
/// @param request_sha256 request_digest(), or "" where it is not known: null
[[nodiscard]] std::string provenance_members(std::string_view kind, std::string_view program,
                                             std::string_view request_sha256);

/// Returns these members for what this program computes of a request or sweep document.
[[nodiscard]] std::string provenance_members(std::string_view kind, const nlohmann::json& document);

/// @brief Returns a document in the JSON Canonicalization Scheme (RFC 8785): members sorted, no white space,
/// numbers as ECMAScript writes them. Documents that differ in spelling alone have the same text. Names sort
/// by UTF-8 bytes, which differs from the scheme only between characters above U+FFFF and U+E000 to U+FFFF.
/// @pre the document is nested no deeper than ParseLimits::depth (api/json_text.h)
[[nodiscard]] std::string canonical_text(const nlohmann::json& document);

/// Returns the SHA-256 digest of canonical_text() as 64 lower-case hexadecimal digits.
[[nodiscard]] std::string request_digest(const nlohmann::json& document);

}  // namespace snapthrough::api
