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

/// Types that values at a place may have.
struct PlaceTypes {
  bool number = false;  ///< with or without a fraction
  bool integer = false;
  bool text = false;
  bool boolean = false;
  bool list = false;
  bool object = false;
};

/// @brief The types that a published schema allows at a place of its documents. Thread-safe.
/// @param schema its name, such as "Result" or "Request"
/// @param tokens of a JSON Pointer, unescaped; an index stands for any element of its list
/// @return nothing set when the schema has no such place, or says nothing of it
[[nodiscard]] PlaceTypes types_at(std::string_view schema, std::span<const std::string> tokens);

}  // namespace snapthrough::api
