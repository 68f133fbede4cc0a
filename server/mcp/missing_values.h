#pragma once
/// @file
/// Values that a request lacks and that only the user can know: they are asked for, never assumed.

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/mcp/dialogue.h"
#include "solver/model/finding.h"

namespace snapthrough::server::mcp {

/// A question for all missing values of a document.
struct Question {
  std::string message;
  std::shared_ptr<const nlohmann::json> schema;  ///< form: an object whose members are named by JSON Pointer
};

/// @brief Returns the question; nullopt when anything else is wrong too, or a missing value is a list or an
/// object, which a form cannot ask for.
/// @param schema name of the published schema of the document
[[nodiscard]] std::optional<Question> question_about(const std::vector<Finding>& findings,
                                                     std::string_view schema);

/// Writes the user's values to their places. @return why a value cannot be taken; "" when all were
[[nodiscard]] std::string take_answer(const nlohmann::json& answer, const Question& question,
                                      nlohmann::json& document);

}  // namespace snapthrough::server::mcp
