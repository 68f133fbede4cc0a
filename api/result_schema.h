#pragma once
/// @file
/// Look-up of places of the result document in the published interface (schema `Result`).

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace snapthrough::api {

/// @brief Returns the ids in a list of the model, such as `monitors` (for `supports` the nodes' ids), which
/// are the member names of some objects of a result (x-ids in the schema); nullopt when any name is valid.
using IdsIn = std::function<std::optional<std::vector<std::string>>(std::string_view list)>;

/// A place that results do not have.
struct NoSuchPlace {
  std::size_t token = 0;    ///< index of the first invalid token
  bool unknown_id = false;  ///< true: the token should be an id of the model
  std::string detail;       ///< sentence with the place that was probably meant
};

/// @brief Looks up a place in the schema of results. Any array index is valid, unless the schema bounds the
/// array. Thread-safe.
/// @param tokens unescaped tokens of a JSON Pointer, at least one
/// @return why no result has the place; nullopt when a result may have it
[[nodiscard]] std::optional<NoSuchPlace> find_no_such_place(std::span<const std::string> tokens,
                                                            const IdsIn& ids_in);

/// Types that a value at a place may have.
struct PlaceTypes {
  bool number = false;  ///< with or without fraction
  bool integer = false;
  bool text = false;
  bool boolean = false;
  bool list = false;
  bool object = false;
};

/// @brief Returns the types that a published schema allows at a place. Thread-safe.
/// @param schema name, such as "Result" or "Request"
/// @param tokens unescaped tokens of a JSON Pointer; an index stands for any element of its list
/// @return no types when the schema lacks the place or leaves it open
[[nodiscard]] PlaceTypes types_at(std::string_view schema, std::span<const std::string> tokens);

}  // namespace snapthrough::api
