#pragma once
/// @file
/// Watches along a path which supports unload from beyond the peak of their reaction law.

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "solver/discrete/structure.h"

namespace snapthrough {

/// @brief Tells which supports were unloaded from beyond the peak of their law along a path.
///
/// A law is elastic: a support that goes back regains what it lost beyond its peak, which soil does not. A
/// model without falling laws costs nothing.
class PeakWatch {
 public:
  /// @param structure kept by reference; must outlive this object
  explicit PeakWatch(const Structure& structure);

  /// Forgets how far supports have gone: a new path begins.
  void start();
  /// Notes a point of the path.
  /// @param y unknowns in equilibrium
  /// @param load_factor of the point: factor on the request's proportional loads
  void note(const Eigen::VectorXd& y, double load_factor);
  /// @brief Sentence that names each support that has gone back, with the load factor at which it first had;
  /// empty: none has.
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  /// A place of a support: a spring, or a point of an element on a foundation.
  struct Place {
    std::size_t spring = 0;
    int part = -1;      ///< index of the foundation's part; -1: a spring
    double xi = 0.0;    ///< place in the element
    double peak = 0.0;  ///< penetration at the peak, scaled
    double most = 0.0;  ///< largest penetration so far
  };
  void add_springs();
  void add_foundations();
  [[nodiscard]] double penetration(const Place& place, const Eigen::VectorXd& y) const;
  [[nodiscard]] const std::string& id_of(const Place& place) const;

  const Structure& structure_;
  std::vector<Place> places_;      ///< places of supports whose law falls
  std::vector<std::string> told_;  ///< ids of supports in `text_`
  std::string text_;
};

}  // namespace snapthrough
