#include "server/resources/form_data.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "server/resources/message.h"

namespace snapthrough::server::http {
namespace {

constexpr std::string_view kLineEnd = "\r\n";

/// Returns the value of a parameter of a header, such as boundary in "multipart/form-data; boundary=x";
/// nullopt when it is absent. A quoted value ends at the next quote, or at an escaped one, which names here
/// never need.
std::optional<std::string> parameter_of(std::string_view header, std::string_view wanted) {
  header.remove_prefix(std::min(header.find(';'), header.size()));
  while (!header.empty()) {
    header.remove_prefix(1);
    const std::size_t equals = header.find_first_of("=;");
    const std::string_view name = trimmed(header.substr(0, equals));
    if (equals == header.npos || header[equals] == ';') {
      header.remove_prefix(std::min(equals, header.size()));
      continue;
    }
    header.remove_prefix(equals + 1);
    const bool quoted = header.starts_with('"');
    header.remove_prefix(quoted ? 1 : 0);
    const std::size_t end = std::min(header.find(quoted ? '"' : ';'), header.size());
    if (equal_ignoring_case(name, wanted)) {
      return std::string(quoted ? header.substr(0, end) : trimmed(header.substr(0, end)));
    }
    header.remove_prefix(end);
    header.remove_prefix(std::min(header.find(';'), header.size()));
  }
  return std::nullopt;
}

/// Returns whether a text may be a boundary (RFC 2046, 5.1.1).
bool is_boundary(std::string_view text) {
  constexpr std::string_view kOthers = "'()+_,-./:=? ";
  const auto allowed = [&](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           kOthers.find(c) != kOthers.npos;
  };
  return !text.empty() && text.size() <= 70 && text.back() != ' ' &&
         std::all_of(text.begin(), text.end(), allowed);
}

/// Reads the parts of a body one after the other.
class FormReader {
 public:
  FormReader(std::string_view body, const std::string& boundary) : rest_(body), mark_("--" + boundary) {}

  FormData read();

 private:
  /// Removes a text from the beginning of the rest; returns false when it is not there.
  bool take(std::string_view text) {
    const bool there = rest_.starts_with(text);
    rest_.remove_prefix(there ? text.size() : 0);
    return there;
  }
  /// Reads a part behind its boundary line. Returns the mistake; "" for none.
  std::string read_part(FormPart& part);
  /// Reads the headers of a part and the empty line behind them. Returns the mistake; "" for none.
  std::string read_headers(FormPart& part);

  std::string_view rest_;
  std::string mark_;
};

FormData FormReader::read() {
  FormData form;
  if (!take(mark_)) {
    return {{}, "The body does not begin with the boundary of its Content-Type."};
  }
  while (!take("--")) {
    FormPart part;
    std::string mistake = form.parts.size() == kMostFormParts ? "The form has too many parts."
                          : take(kLineEnd)                    ? read_part(part)
                                                              : "A boundary does not end its line.";
    if (!mistake.empty()) {
      return {{}, std::move(mistake)};
    }
    form.parts.push_back(std::move(part));
  }
  return form;
}

std::string FormReader::read_part(FormPart& part) {
  if (std::string mistake = read_headers(part); !mistake.empty()) {
    return mistake;
  }
  const std::string end = std::string(kLineEnd) + mark_;
  const std::size_t at = rest_.find(end);
  if (at == rest_.npos) {
    return "The last boundary is missing: the form is incomplete.";
  }
  part.content = rest_.substr(0, at);
  rest_.remove_prefix(at + end.size());
  return "";
}

std::string FormReader::read_headers(FormPart& part) {
  while (!take(kLineEnd)) {
    const std::size_t end = rest_.find(kLineEnd);
    if (end == rest_.npos) {
      return "The headers of a part do not end with an empty line.";
    }
    const std::string_view header = rest_.substr(0, end);
    const std::string_view name = trimmed(header.substr(0, header.find(':')));
    if (equal_ignoring_case(name, "Content-Transfer-Encoding")) {
      return "A part of a form has no Content-Transfer-Encoding.";
    }
    if (equal_ignoring_case(name, "Content-Disposition")) {
      part.name = parameter_of(header, "name").value_or("");
    }
    rest_.remove_prefix(end + kLineEnd.size());
  }
  return part.name.empty() ? "A part of a form has a Content-Disposition with the name of its field." : "";
}

}  // namespace

FormData read_form_data(std::string_view content_type, std::string_view body) {
  const std::optional<std::string> boundary = parameter_of(content_type, "boundary");
  if (!boundary || !is_boundary(*boundary)) {
    return {{}, "The Content-Type of a form has a boundary of 1 to 70 characters."};
  }
  return FormReader(body, *boundary).read();
}

}  // namespace snapthrough::server::http
