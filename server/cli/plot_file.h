#pragma once
/// @file
/// Writes files of figures atomically.

#include <string>

namespace snapthrough::server::cli {

/// Writes a text to a file, which keeps its old content until the text is complete.
/// @return the error as a sentence; "" after success
[[nodiscard]] std::string write_whole(const std::string& text, const std::string& file);

/// @brief Writes an SVG text as a PNG file with the program rsvg-convert (Debian: librsvg2-bin), run without
/// a shell. The file keeps its old content until the PNG is complete.
/// @param scale PNG pixels for each SVG pixel
/// @return the error as a sentence; "" after success
[[nodiscard]] std::string write_png(const std::string& svg, const std::string& file, double scale);

/// @brief Writes an SVG text as PNG into `png`, as write_png() does into a file.
/// @return the error as a sentence; "" after success
[[nodiscard]] std::string png_of(const std::string& svg, std::string& png);

}  // namespace snapthrough::server::cli
