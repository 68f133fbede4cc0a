#pragma once
/// @file
/// Bodies of several files: multipart/form-data (RFC 7578), as browsers and curl -F send it.

#include <string>
#include <string_view>
#include <vector>

namespace snapthrough::server::http {

/// A part of a form.
struct FormPart {
  std::string name;          ///< name of the form's field
  std::string_view content;  ///< byte for byte, inside the body
};

/// The parts in order of arrival; no parts where `mistake` is set.
struct FormData {
  std::vector<FormPart> parts;
  std::string mistake;  ///< what breaks the rules of the format, as a sentence; empty: nothing
};

/// Largest number of parts of a form.
inline constexpr std::size_t kMostFormParts = 16;

/// @brief Reads a form. Each part has a Content-Disposition with a name and no Content-Transfer-Encoding; no
/// text stands before the first part.
/// @param content_type value of the Content-Type header, which has the boundary
/// @param body must outlive the result
[[nodiscard]] FormData read_form_data(std::string_view content_type, std::string_view body);

}  // namespace snapthrough::server::http
