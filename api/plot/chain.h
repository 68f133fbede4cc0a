#pragma once
/// @file
/// Members that continue one another, and a coordinate of the places on them: depth, height or distance.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "api/plot/model.h"

namespace snapthrough::api::plot {

/// Members one after another, each joined to the next at a node that no other of them has.
struct Chain {
  struct Link {
    const ModelMember* member = nullptr;
    bool backwards = false;  ///< the chain passes the member from its end to its start
    double from = 0;         ///< length of the members before it
  };
  std::vector<Link> links;
  /// Whether the chain goes down everywhere, and by more than it goes sideways: its places then have heights.
  /// Else they have distances along the chain.
  bool goes_down = false;
};

/// Returns members as chains; closed ones begin at their first member.
[[nodiscard]] std::vector<Chain> chains_of(const std::vector<const ModelMember*>& members);

/// Returns the height y of a place on a chain that goes down, else its distance from the chain's start.
[[nodiscard]] double coordinate_on(const Chain& chain, std::size_t link, double fraction);

}  // namespace snapthrough::api::plot
