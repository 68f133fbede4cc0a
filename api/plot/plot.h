#pragma once
/// @file
/// Figures of results and of tables of sweeps as SVG texts, in the look of the page's figures.
///
/// Pure functions: no files, no threads, no global state. The same document and request give the same bytes.

#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "api/json_text.h"
#include "api/names.h"

namespace snapthrough::api {

enum class PlotKind {
  path,      ///< equilibrium path: load factor over a monitor, or over the arc length
  shape,     ///< a state: undeformed and deformed members, contact, reactions
  sections,  ///< axial force, shear force, bending moment along the members of a state
  mode,      ///< a buckling mode, or the mode of a critical point
  sweep,     ///< an output of a sweep over one parameter, a curve for each value of a second one
  heatmap    ///< an output of a sweep over two parameters
};

inline constexpr Named<PlotKind> kPlotKinds[] = {
    {"path", PlotKind::path}, {"shape", PlotKind::shape}, {"sections", PlotKind::sections},
    {"mode", PlotKind::mode}, {"sweep", PlotKind::sweep}, {"heatmap", PlotKind::heatmap}};

/// Documents that are drawn may have more values than requests: results of long paths, tables of large
/// sweeps.
inline constexpr ParseLimits kFigureLimits{64, 20'000'000};
inline constexpr double kLeastPlotSize = 200;  ///< pixels, of width and height
inline constexpr double kLargestPlotSize = 8000;

/// What a figure is to show. A member that the kind does not use is ignored; one that is left out is chosen
/// as described.
struct PlotRequest {
  std::optional<PlotKind> kind;  ///< left out: default_plot_kind()
  std::optional<double> width;   ///< pixels, kLeastPlotSize to kLargestPlotSize; left out: 720
  std::optional<double> height;  ///< the same; left out: 480, sections 600
  bool dark = false;             ///< light lines on dark paper
  /// shape, sections: index in `states`; left out: that of the first critical point that has one, else the
  /// last state.
  std::optional<std::size_t> state;
  /// mode: index in `buckling.modes`, else in `critical_points`; left out: the first one.
  std::optional<std::size_t> mode;
  std::optional<std::size_t> branch;   ///< path: index in `branches`, drawn alone; left out: all
  std::optional<std::string> monitor;  ///< path: id on the horizontal axis; left out: the first monitor
  bool over_arc_length = false;        ///< path: the arc length on the horizontal axis
  /// shape: displacements are drawn so many times as large, > 0. Left out: 1, or where displacements are too
  /// small to be seen a round number, which the figure states. mode: size of the mode, times a tenth of the
  /// structure.
  std::optional<double> magnify;
  std::optional<std::string> output;  ///< sweep, heatmap: column; left out: the first output with numbers
  std::optional<std::string> x;       ///< sweep, heatmap: parameter on the horizontal axis
  std::optional<std::string> by;  ///< sweep: parameter with a curve for each value; heatmap: vertical axis
  std::map<std::string, std::string> where;  ///< sweep, heatmap: only rows with these values of parameters
  /// The request document that was solved, or null. shape and mode then show supports, springs, ground and
  /// loads, path the sense and unit of monitors. It must outlive the call.
  const nlohmann::json* solved_request = nullptr;
};

/// @brief A document or a request that no figure can be made of.
class PlotError : public std::runtime_error {
 public:
  /// @param pointer JSON Pointer into the document; into the solved request where it begins with "request:"
  /// @param rule what must hold there, as a sentence
  PlotError(std::string pointer, std::string rule);
  [[nodiscard]] const std::string& pointer() const { return pointer_; }
  [[nodiscard]] const std::string& rule() const { return rule_; }

 private:
  std::string pointer_;
  std::string rule_;
};

/// @brief The figure that fits a document best: table with two parameters of more than six values each:
/// heatmap; with others: sweep. Result with buckling modes: mode; with static rows and
/// states: shape; with branches or static rows: path; else with states: shape; else mode.
/// @throws PlotError when it is neither a result nor a table
[[nodiscard]] PlotKind default_plot_kind(const nlohmann::json& document);

/// @brief SVG text of a result document (as `snapthrough solve` prints it) or of a table of a sweep (as
/// `snapthrough sweep` prints it).
///
/// The text is one XML document in UTF-8 with its styles inside, with <title> and <desc>, texts as text and
/// finite numbers only. Work and memory are proportional to the document. Reentrant.
/// @throws PlotError when the document or the request is wrong; nothing else but std::bad_alloc
[[nodiscard]] std::string svg_of(const nlohmann::json& document, const PlotRequest& request = {});

}  // namespace snapthrough::api
