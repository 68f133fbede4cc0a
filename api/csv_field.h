#pragma once
/// @file
/// Fields of CSV tables (RFC 4180).

#include <string>
#include <string_view>

namespace snapthrough::api {

/// Appends a field, quoted if it contains a comma, a quote or a line end.
void append_csv_field(std::string& text, std::string_view field);

/// Appends a text as append_csv_field() does; an apostrophe precedes a text that spreadsheets would take for
/// a formula: its first character that is no white space is = + - @, or one of these in full width, or it
/// begins with a tab or a carriage return.
void append_csv_text(std::string& text, std::string_view field);

}  // namespace snapthrough::api
