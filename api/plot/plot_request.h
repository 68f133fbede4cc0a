#pragma once
/// @file
/// What is asked of a figure: its kind and its choices. Limits of its size and of the documents to plot.

#include <cstddef>
#include <limits>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "api/json_text.h"
#include "api/names.h"

namespace snapthrough::api {

enum class PlotKind {
  path,         ///< equilibrium path: load factor over a monitor, or over the arc length
  shape,        ///< a state: undeformed and deformed members, contact, reactions
  sections,     ///< axial force, shear force, bending moment along the members of a state
  mode,         ///< a buckling mode, or the mode of a critical point
  model,        ///< the undeformed structure of a request, with supports, springs, ground and loads
  law,          ///< reaction of a spring or foundation over its displacement, of a request or model
  laws,         ///< reactions of all supports of a request or model over their displacements, by depth
  frequencies,  ///< natural circular frequencies over the load factor
  stiffness,    ///< stiffness ratio along the primary path over the load factor
  sweep,        ///< an output of a sweep over one parameter, a curve for each value of a second one
  heatmap       ///< an output of a sweep over two parameters
};

inline constexpr Named<PlotKind> kPlotKinds[] = {
    {"path", PlotKind::path},           {"shape", PlotKind::shape},
    {"sections", PlotKind::sections},   {"mode", PlotKind::mode},
    {"model", PlotKind::model},         {"law", PlotKind::law},
    {"laws", PlotKind::laws},           {"frequencies", PlotKind::frequencies},
    {"stiffness", PlotKind::stiffness}, {"sweep", PlotKind::sweep},
    {"heatmap", PlotKind::heatmap}};

/// Limits of documents to plot. They exceed those of requests: long paths and large sweeps have many values.
inline constexpr ParseLimits kFigureLimits{64, 20'000'000};
inline constexpr double kLeastPlotSize = 200;  ///< pixels; smallest width and height
inline constexpr double kLargestPlotSize = 8000;

/// Choices of a figure. Members that the kind does not use are ignored; each comment gives the default.
struct PlotRequest {
  std::optional<PlotKind> kind;  ///< default: default_plot_kind()
  std::optional<double> width;   ///< pixels, kLeastPlotSize to kLargestPlotSize; default: 720
  std::optional<double> height;  ///< pixels, same limits; default: 480, sections 600
  bool dark = false;             ///< light lines on a dark background
  /// shape, sections: index in `states`; default: the state of the first critical point with a state, else
  /// the last state.
  std::optional<std::size_t> state;
  /// mode: index in `buckling.modes`, else in `critical_points`; default: the first mode.
  std::optional<std::size_t> mode;
  std::optional<std::size_t> branch;   ///< path: index in `branches` of the only branch drawn; default: all
  std::optional<std::string> monitor;  ///< path: monitor on the horizontal axis; default: the first monitor
  bool over_arc_length = false;        ///< path: true plots over the arc length
  bool points = false;                 ///< path: true marks the points at which an equilibrium was solved
  /// shape: factor of displacements, > 0. Default: 1, or a round number when displacements are too small to
  /// see; the caption states it. mode: amplitude in tenths of the structure's extent.
  std::optional<double> magnify;
  /// law: id of the spring or foundation; default: the first one with a law, springs first. laws: id of the
  /// only spring, foundation, foundation in soil or member with joints that is drawn; default: all
  std::optional<std::string> law;
  std::optional<std::string> output;  ///< sweep, heatmap: column; default: the first output with numbers
  std::optional<std::string> x;       ///< sweep, heatmap: parameter on the horizontal axis
  std::optional<std::string> by;  ///< sweep: parameter with a curve for each value; heatmap: vertical axis
  std::map<std::string, std::string> where;  ///< sweep, heatmap: draw only rows with these parameter values
  /// Largest number of coordinates of the figure, which bounds its memory and its text; more are an error.
  /// The points of members' curves, which are sampled whether or not they are drawn, have two each. Default:
  /// none.
  std::size_t most_coordinates = std::numeric_limits<std::size_t>::max();
  /// The request that gave the result, or null. shape and mode need it for supports, springs, ground and
  /// loads, path for direction and unit of monitors, law and laws for the laws when the document has no
  /// model. It must outlive the call.
  const nlohmann::json* solved_request = nullptr;
};

/// Adds a condition "NAME=VALUE" to `where`. Returns false for a text without "=", and for a name that has a
/// condition already.
[[nodiscard]] bool add_condition(std::string_view text, PlotRequest& request);

}  // namespace snapthrough::api
