#pragma once
/// @file
/// Watches along a path which supports and joints unload from beyond the peak of their law.

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "solver/discrete/structure.h"

namespace snapthrough {

/// @brief Tells which supports and joints were unloaded from beyond the peak of their law along a path.
///
/// A law is elastic: what goes back regains what it lost beyond its peak, which neither soil nor a connection
/// does. A model without falling laws costs nothing.
class PeakWatch {
 public:
  /// @param structure kept by reference; must outlive this object
  explicit PeakWatch(const Structure& structure);

  /// Forgets how far supports and joints have gone: a new path begins.
  void start();
  /// Notes a point of the path.
  /// @param y unknowns in equilibrium
  /// @param load_factor of the point: factor on the request's proportional loads
  void note(const Eigen::VectorXd& y, double load_factor);
  /// @brief List of the supports and joints that have gone back, with the load factor at which each first
  /// had; empty: none has.
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  /// What has a law that falls: a spring, a joint, or a point of an element on a foundation.
  struct Place {
    enum class Kind { spring, joint, foundation };
    Kind kind = Kind::spring;
    std::size_t index = 0;  ///< among the model's springs, Structure::joints or Structure::foundation_parts
    double xi = 0.0;        ///< place in the element, of a foundation
    double peak = 0.0;      ///< penetration at the peak, scaled
    double most = 0.0;      ///< largest penetration so far
  };
  void add_springs();
  void add_joints();
  void add_foundations();
  [[nodiscard]] double penetration(const Place& place, const Eigen::VectorXd& y) const;
  [[nodiscard]] double depth_in(const FoundationPart& part, double xi, const Eigen::VectorXd& y) const;
  [[nodiscard]] std::string name_of(const Place& place) const;

  const Structure& structure_;
  std::vector<Place> places_;      ///< places whose law falls
  std::vector<std::string> told_;  ///< names in `text_`
  std::string text_;
};

}  // namespace snapthrough
