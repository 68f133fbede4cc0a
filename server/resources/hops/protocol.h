#pragma once
/// @file
/// Documents of the Hops protocol, with which Grasshopper calls functions of other programs: descriptions of
/// components, calls, and answers.
///
/// The protocol defines the names of members. Hops shows the texts of `errors` and `warnings` at the
/// component; it ignores other members of an answer that is not 200, and all statuses except 500 and 408.

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "server/resources/hops/catalogue.h"

namespace snapthrough::server::hops {

/// The output of every component that gives the path of the call's job.
inline constexpr std::string_view kJobOutput = "job";

/// Kind of document that an address of the protocol answers, also for refusals.
enum class Form {
  none,         ///< not an address of the protocol, or one for any client
  description,  ///< description of one component
  answer        ///< answer to a call
};
[[nodiscard]] Form form_of(std::string_view method, std::string_view path);

/// Returns whether a path belongs to descriptions of components.
[[nodiscard]] bool is_description_path(std::string_view path);

/// Returns the description of a component, with the errors of its file.
[[nodiscard]] nlohmann::ordered_json description(std::string_view name, const Entry& entry);

/// Returns a document of a form that contains only errors. @pre form is not none
[[nodiscard]] std::string refusal(Form form, const std::vector<std::string>& errors);

/// Returns a sentence for each of the first findings, and one with the number of the others.
[[nodiscard]] std::vector<std::string> sentences_of(const std::vector<Finding>& findings);

/// @brief Returns the component that a call's `pointer` names in its last segment; "" when absent.
[[nodiscard]] std::string name_in(const nlohmann::json& call);

/// The values of a call, or findings about them.
struct ReadValues {
  std::map<std::string, nlohmann::json> values;  ///< values by name of the input, of the input's type
  std::vector<Finding> findings;                 ///< pointers are "/" and an input's name
};

/// @brief Reads `values` of a call. Inputs that the call lacks are left out.
/// @param call document sent by Hops; other members are ignored
[[nodiscard]] ReadValues read_values(const nlohmann::json& call, const Definition& definition);

/// An answer, or the reason why there is none.
struct Answer {
  std::string text;   ///< document; empty: see `error`
  std::string error;  ///< why there is no answer, as a sentence
};

/// @brief Returns the answer to a call.
/// @param pointer pointer of the call, which the answer repeats
/// @param result has at least the definition's parts() and `warnings`
/// @param job path of the job that computed the result
[[nodiscard]] Answer answer(const Definition& definition, std::string_view pointer,
                            const nlohmann::json& result, std::string_view job);

}  // namespace snapthrough::server::hops
