#pragma once
/// @file
/// Conversion of soil parameters, tables and drawings into parts of a model. Every function is reentrant, and
/// polls WorkLimit (solver/numeric/work_limit.h) in loops whose length the input sets.

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/model/finding.h"
#include "solver/result.h"

namespace snapthrough::api {

/// Parts of a model, or the mistakes of the input.
struct Conversion {
  std::shared_ptr<nlohmann::json> document;  ///< members of `model`, such as "nodes"; null with findings
  std::vector<Finding> findings;
  std::vector<Warning> warnings = {};  ///< what the document leaves out or does not join; convert_dxf() only
};

/// @brief Returns the `foundations` of a pile in layered soil: p-y laws of API RP 2GEO and Matlock by depth.
///
/// docs/howto/convert.md has the fields of the document and the formulas. The document may also be a request,
/// whose foundations in soil are replaced by those that their soil gives. A finding names its field by a JSON
/// Pointer into the document.
/// @param text UTF-8 JSON; the caller limits its size
[[nodiscard]] Conversion convert_soil(std::string_view text);
/// Converts a parsed document as convert_soil() does its text.
[[nodiscard]] Conversion convert_soil_document(const nlohmann::json& soil);

/// A table of comma-separated values with its name in messages.
struct CsvFile {
  std::string name;
  std::string text;
};

/// Tables of a structure.
struct CsvFiles {
  CsvFile nodes;                    ///< columns id, x, y
  CsvFile members;                  ///< columns id, start, end, section, optional sweep_degrees
  std::optional<CsvFile> sections;  ///< columns id, optional EA, EI, GA, E, A, I, nu, shear_area
};

/// @brief Returns `nodes`, `members` and `sections` from tables (RFC 4180) whose first row names the columns.
///
/// Without a table of sections, `sections` lists the ids that members name. A finding names its field by
/// file, line and column's name.
[[nodiscard]] Conversion convert_csv(const CsvFiles& files);

/// Choices for reading a drawing.
struct DxfOptions {
  std::vector<std::string> layers;  ///< layers to read; empty: all
  std::optional<double> tolerance;  ///< nodes join within it, > 0; default: 1e-6 of the larger side of the
                                    ///< rectangle around all end points
  bool join_tees = false;           ///< divide a segment where an end lies on it within the tolerance
};

/// @brief Returns `nodes`, `members` and `sections` from the lines, arcs and polylines of an ASCII drawing.
///
/// A member is a line or an arc; the name of its layer is the id of its section. A finding names its place by
/// the line of the file, such as "line 12". Segments that are drawn twice give one member. Warnings tell
/// those, ends that are joined at a distance, and places that only look joined (api/convert/dxf_joints.h).
[[nodiscard]] Conversion convert_dxf(std::string_view text, const DxfOptions& options);

/// Returns the text of converted parts, as `snapthrough convert` prints it.
[[nodiscard]] std::string write_parts(const nlohmann::json& parts);

}  // namespace snapthrough::api
