#pragma once
/// @file
/// Elements and supports of a structure.

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/element/element_set.h"
#include "solver/support/law.h"

namespace snapthrough {

/// @brief Adds the supports of a model to a structure: on elements and at nodes.
class SupportBuilder {
 public:
  /// @param foundations, springs laws of the supports of `out.laws`, kept by reference
  /// @param like null, or a structure with the same mesh, axes and scales, whose parts are taken over where
  /// they do not differ
  /// @param out kept by reference; its unknowns and laws are set
  SupportBuilder(const std::vector<FoundationLaw>& foundations, const std::vector<SpringLaw>& springs,
                 const Structure* like, Structure& out)
      : model_(*out.model),
        laws_(*out.laws),
        foundation_laws_(foundations),
        spring_laws_(springs),
        like_(like),
        out_(out) {}

  /// Makes the elements with their supports, and lists the parts of foundations in the structure.
  [[nodiscard]] std::unique_ptr<ElementSet> make_elements();
  /// Adds rigid supports and springs at nodes.
  void add_at_nodes();

 private:
  /// Supports of an element: indices of foundations of the model, and of foundations and springs of `laws_`.
  struct Here {
    std::vector<int> foundations, laws;
    std::vector<std::size_t> springs;
  };
  void find_supports();
  void add_foundations(const std::vector<ResolvedFoundation>& foundations, std::vector<int> Here::*list);
  void add_shape(int element);
  void add_element_supports(int element);
  void add_foundation(int element, int index);
  void add_foundation_law(int element, int index);
  void add_contacts(int element, int index);
  void add_point_spring(int element, std::size_t index);
  void add_unresolved();
  [[nodiscard]] Touch touch_of_spring(std::size_t index) const;
  [[nodiscard]] const FoundationContact* known_contact(int element, const FoundationLaw& law,
                                                       std::array<double, 2> range) const;
  [[nodiscard]] FoundationContact make_contact(int element, const FoundationLaw& foundation, int index,
                                               std::array<double, 2> range) const;

  const ResolvedModel& model_;
  const ResolvedModel& laws_;
  const std::vector<FoundationLaw>& foundation_laws_;
  const std::vector<SpringLaw>& spring_laws_;
  const Structure* like_;
  Structure& out_;
  std::vector<Here> here_;  ///< one per element
  std::unique_ptr<ElementSet> elements_;
};

}  // namespace snapthrough
