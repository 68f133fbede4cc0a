#pragma once
/// @file
/// Places of the result document, as the published interface describes it (schema `Result`).

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace snapthrough::api {

/// @brief The ids of a list of the model, such as `monitors` (for `supports` those of their nodes), which
/// name members of some objects of a result (x-ids in the schema); nothing when any name will do.
using IdsIn = std::function<std::optional<std::vector<std::string>>(std::string_view list)>;

/// A place that results do not have.
struct NoSuchPlace {
  std::size_t token = 0;    ///< the first token that leads nowhere
  bool unknown_id = false;  ///< it should name something of the model
  std::string detail;       ///< a sentence, with the place that was probably meant
};

/// @brief Looks a place up in the schema of results. An array index may be any, unless the schema bounds the
/// array. Thread-safe.
/// @param tokens of a JSON Pointer, unescaped, at least one
/// @return why no result has this place; nothing when one may
[[nodiscard]] std::optional<NoSuchPlace> find_no_such_place(std::span<const std::string> tokens,
                                                            const IdsIn& ids_in);

}  // namespace snapthrough::api
