#pragma once
/// @file
/// Fields of CSV tables (RFC 4180).

#include <string>
#include <string_view>

namespace snapthrough::api {

/// Appends a field, in quotes where it holds a comma, a quote or a line end.
void append_csv_field(std::string& text, std::string_view field);

/// The same for a name or a text, which spreadsheets take for a formula when it begins with = + - @, a tab or
/// a carriage return: an apostrophe before it says that it is none.
void append_csv_text(std::string& text, std::string_view field);

}  // namespace snapthrough::api
