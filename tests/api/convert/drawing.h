#pragma once
/// @file
/// Drawings as texts, for the tests of their conversion.

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace snapthrough::testing {

/// Returns lines "code\nvalue\n" from "code value; code value; ...".
inline std::string groups(const std::string& text) {
  std::string lines;
  std::istringstream in(text);
  for (std::string pair; std::getline(in, pair, ';');) {
    const std::size_t first = pair.find_first_not_of(' ');
    const std::size_t blank = pair.find(' ', first);
    lines += pair.substr(first, blank - first) + "\n" + pair.substr(blank + 1) + "\n";
  }
  return lines;
}

/// Returns a drawing with these entities, whose first line is line 5.
inline std::string drawing(const std::string& entities) {
  return groups("0 SECTION; 2 ENTITIES") + groups(entities) + groups("0 ENDSEC; 0 EOF");
}

/// Returns a drawing with these entities one after the other.
inline std::string drawing(const std::vector<std::string>& entities) {
  std::string text;
  for (const std::string& entity : entities) {
    text += (text.empty() ? "" : "; ") + entity;
  }
  return drawing(text);
}

/// A LINE, which has 12 lines of text.
inline std::string line(double x0, double y0, double x1, double y1, const std::string& layer = "wall") {
  return "0 LINE; 8 " + layer + "; 10 " + std::to_string(x0) + "; 20 " + std::to_string(y0) + "; 11 " +
         std::to_string(x1) + "; 21 " + std::to_string(y1);
}

/// An ARC, which has 14 lines of text.
inline std::string arc(double x, double y, double radius, double from, double to) {
  return "0 ARC; 8 wall; 10 " + std::to_string(x) + "; 20 " + std::to_string(y) + "; 40 " +
         std::to_string(radius) + "; 50 " + std::to_string(from) + "; 51 " + std::to_string(to);
}

/// An arc between two points by the tangent of a quarter of its angle, which has 14 lines of text.
inline std::string bulge(double x0, double y0, double x1, double y1, double tangent) {
  return "0 LWPOLYLINE; 8 wall; 10 " + std::to_string(x0) + "; 20 " + std::to_string(y0) + "; 42 " +
         std::to_string(tangent) + "; 10 " + std::to_string(x1) + "; 20 " + std::to_string(y1);
}

/// Returns start and end node of each member.
inline std::vector<std::string> ends(const nlohmann::json& parts) {
  std::vector<std::string> all;
  for (const nlohmann::json& member : parts.at("members")) {
    all.push_back(member["start"].get<std::string>() + "-" + member["end"].get<std::string>());
  }
  return all;
}

}  // namespace snapthrough::testing
