#pragma once
/// @file
/// How the segments of a drawing meet: pieces that are drawn twice, ends on segments, and what only looks
/// joined.

#include <cstddef>
#include <string>
#include <vector>

#include "api/convert/dxf_segments.h"
#include "solver/geometry/point_tree.h"
#include "solver/numeric/number_text.h"
#include "solver/result.h"

namespace snapthrough::api::convert {

/// A line or arc between two nodes: a segment, or a part of it.
struct Piece {
  const Segment* drawn = nullptr;  ///< the segment that it is a part of
  int start = 0;
  int end = 0;
  double sweep_degrees = 0.0;  ///< angle by which an arc turns to the left; 0: a line
};

/// Places of one kind in a drawing: the first ones as text, and how many there are.
class Places {
 public:
  /// @param place returns the text of a place; called for the first ones only
  template <typename Text>
  void add(Text place) {
    if (count_++ < MessageLimits::items) {
      text_ += (text_.empty() ? "" : ", ") + place();
    }
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  /// Adds a warning "COUNT ABOUT: PLACES; REMEDY" if there is a place.
  /// @param one, several what the places are, for one and for more places
  void warn(const char* code, const char* one, const char* several, const std::string& remedy,
            std::vector<Warning>& out) const;

 private:
  std::size_t count_ = 0;
  std::string text_;
};

/// Ends that were joined to a place at other coordinates: how many, and the farthest.
class Moves {
 public:
  explicit Moves(double rounding) : rounding_(rounding) {}
  /// Notes a move if it is longer than rounding explains.
  void add(double distance, const PlanePoint& from, const Segment& drawn);
  /// Adds a warning "COUNT ABOUT, the farthest ...; REMEDY" if there is a move.
  void warn(const char* code, const char* one, const char* several, const std::string& remedy,
            std::vector<Warning>& out) const;

 private:
  double rounding_;
  std::size_t count_ = 0;
  double farthest_ = 0.0;
  PlanePoint from_{};
  std::size_t line_ = 0;
};

/// A point as messages show it, such as "(3, 0.5)".
[[nodiscard]] std::string place_of(const PlanePoint& point);
/// "the segment of line 18".
[[nodiscard]] std::string name_of(const Piece& piece);

/// What joints() looks at: pieces between nodes that are farther from each other than the tolerance.
struct DrawnPieces {
  std::vector<Piece> pieces;
  PointTree nodes;
  std::size_t node_count = 0;
  double tolerance = 0.0;
  double rounding = 0.0;   ///< distance that rounding of coordinates may cause
  bool join_tees = false;  ///< whether an end on a segment divides it
};

/// @brief Drops pieces that are drawn twice, divides segments at the ends on them if that is asked for, and
/// tells what was done and what only looks joined.
///
/// Two pieces are one where they have one layer, the same two nodes in any order, and are within the
/// tolerance of each other everywhere. An end lies on a segment where it is within the tolerance of it and no
/// node of it. The parts of a divided arc share its angle, so that its curvature stays. Warnings:
/// - `duplicates_dropped`: pieces that are drawn twice;
/// - `stacked_members`: pieces that differ by their layer alone, which stay;
/// - `tee_unjoined`: ends on segments that they are not joined to, and, in a second warning, ends that are
///   farther off than the tolerance, by 1e-3 of the shorter segment at most;
/// - `tees_moved`: segments that were divided at an end that is not on them but within the tolerance;
/// - `near_nodes`: nodes that are nearer to each other than 1e-3 of the shorter segment;
/// - `crossings`: crossings without an end there.
/// @return the members
[[nodiscard]] std::vector<Piece> joints(DrawnPieces drawn, std::vector<Warning>& warnings);

/// @name Parts of joints()
/// @{

/// Line or arc by arc length.
struct Shape {
  PlanePoint start{};
  PlanePoint tangent{};    ///< at the start, of length 1
  double curvature = 0.0;  ///< positive: turns to the left
  double length = 0.0;
  double chord = 0.0;
  double rise = 0.0;  ///< largest distance from the chord, to its right
};
[[nodiscard]] Shape shape_of(const Piece& piece, const PointTree& nodes);

/// Distance of a point from a line or circle, which go on beyond the ends of the shape.
[[nodiscard]] double distance_from(const Shape& shape, const PlanePoint& point);
/// Fraction of the length at which a line or arc is nearest to a point; outside of [0, 1] beyond the ends.
[[nodiscard]] double fraction_at(const Shape& shape, const PlanePoint& point);

/// Returns the pieces without those that are drawn twice.
[[nodiscard]] std::vector<Piece> without_duplicates(const DrawnPieces& drawn, Places& dropped,
                                                    Places& stacked);
/// Tells ends on segments. Returns the pieces, divided there if that is asked for.
[[nodiscard]] std::vector<Piece> with_tees(const DrawnPieces& drawn, std::vector<Warning>& warnings);
void tell_near_nodes(const DrawnPieces& drawn, std::vector<Warning>& warnings);
void tell_crossings(const DrawnPieces& drawn, std::vector<Warning>& warnings);

/// Length of the shortest piece at each node.
[[nodiscard]] std::vector<double> shortest_at_nodes(const DrawnPieces& drawn);

/// Tolerance of places that only look joined, in lengths of the shortest segment, as in the solver's warnings
/// on a model.
inline constexpr double kNear = 1e-3;
/// @}

}  // namespace snapthrough::api::convert
