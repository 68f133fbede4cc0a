#pragma once
/// @file
/// The foundations of a model whose soil gives laws by depth. Internal to api/.

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "api/value.h"

namespace snapthrough::api {

/// A foundation or spring that an entry of a request's `foundations` gives.
struct ListedSupport {
  std::size_t entry = 0;  ///< index in `foundations`
  nlohmann::json made;    ///< what the soil of that entry gives; null: the entry has its own stiffness or law
};

/// What the `foundations` of a request give.
struct ListedSupports {
  std::vector<ListedSupport> foundations;
  std::vector<ListedSupport> springs;  ///< at the bases of piles; they follow the request's own springs
};

/// Returns whether a model has soils, or foundations that name a soil or are the soil around a pipe.
[[nodiscard]] bool has_soil(const nlohmann::json& model);

/// @brief Returns the foundations of a model, where those in soil are replaced by foundations with laws, and
/// the springs that the soil gives at bases.
///
/// Reports mistakes in `soils` and in foundations that name a soil or have a `pipe`. Such a foundation with a
/// mistake is unreadable in the report, and has one foundation without stiffness and law. @pre
/// model.is_object()
[[nodiscard]] ListedSupports list_foundations(const Value& model);

/// Returns a model whose foundations in soil are replaced by those that the soil gives, with its springs.
/// Foundations with a mistake are left out. The result has no `soils`.
[[nodiscard]] nlohmann::json with_laws_of_soil(const nlohmann::json& model);

/// Replaces the indices of listed foundations and springs in pointers by those of the request's
/// `foundations`. Findings about several of them that one entry gives become one.
void name_foundation_entries(const nlohmann::json& document, std::vector<Finding>& findings);

}  // namespace snapthrough::api
