#pragma once
/// @file
/// Fields of CSV tables (RFC 4180).

#include <string>
#include <string_view>

namespace snapthrough::api {

/// Appends a field, in quotes where it holds a comma, a quote or a line end.
void append_csv_field(std::string& text, std::string_view field);

}  // namespace snapthrough::api
