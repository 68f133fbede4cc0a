#pragma once
/// @file
/// Files of figures that are whole or not there.

#include <string>

namespace snapthrough::server::cli {

/// Writes a text to a file; what was there before stays until the text is whole.
/// @return what went wrong as a sentence; empty: nothing
[[nodiscard]] std::string write_whole(const std::string& text, const std::string& file);

/// @brief Writes an SVG text as PNG, by the program rsvg-convert (Debian: librsvg2-bin), which is run without
/// a shell. The file is as write_whole() leaves it.
/// @param scale pixels of the PNG for each of the SVG
/// @return what went wrong as a sentence; empty: nothing
[[nodiscard]] std::string write_png(const std::string& svg, const std::string& file, double scale);

}  // namespace snapthrough::server::cli
