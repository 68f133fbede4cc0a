#pragma once
/// @file
/// The protocol of Hops, by which Grasshopper calls functions of other programs: the documents that describe
/// components, those that call them, and those that answer.
///
/// Names of members are the protocol's. Hops reads `errors` and `warnings` as texts and shows them at the
/// component; it looks at no other member of an answer that is not 200, and at no status but 500 and 408.

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "server/resources/hops/catalogue.h"

namespace snapthrough::server::hops {

/// The output that every component has: where the job of the call is found.
inline constexpr std::string_view kJobOutput = "job";

/// What an address of the protocol answers, its refusals included.
enum class Form {
  none,         ///< no address of the protocol, or one that any client reads
  description,  ///< of one component
  answer        ///< to a call
};
[[nodiscard]] Form form_of(std::string_view method, std::string_view path);

/// Whether a path is that of descriptions of components.
[[nodiscard]] bool is_description_path(std::string_view path);

/// The description of a component, with the errors of its file if it has any.
[[nodiscard]] nlohmann::ordered_json description(std::string_view name, const Entry& entry);

/// A document of that form that only says what is wrong. @pre form is not none
[[nodiscard]] std::string refusal(Form form, const std::vector<std::string>& errors);

/// What findings say, a sentence for each of the first, and the number of the others.
[[nodiscard]] std::vector<std::string> sentences_of(const std::vector<Finding>& findings);

/// @brief The name of the component that a call's `pointer` is for: its last segment; empty when it has none.
[[nodiscard]] std::string name_in(const nlohmann::json& call);

/// The values of a call, or what is wrong with them.
struct ReadValues {
  std::map<std::string, nlohmann::json> values;  ///< by name of the input, each of its type
  std::vector<Finding> findings;                 ///< pointers are "/" and the name of an input
};

/// @brief Reads `values` of a call. Inputs that the definition has and the call does not are left out.
/// @param call a document as Hops sends it; its other members play no role
[[nodiscard]] ReadValues read_values(const nlohmann::json& call, const Definition& definition);

/// An answer, or why there can be none.
struct Answer {
  std::string text;   ///< the document; empty: see error
  std::string error;  ///< a sentence
};

/// @brief The answer to a call.
/// @param pointer of the call, which it repeats
/// @param result with at least the definition's parts(), and `warnings`
/// @param job the path of the job that computed it
[[nodiscard]] Answer answer(const Definition& definition, std::string_view pointer,
                            const nlohmann::json& result, std::string_view job);

}  // namespace snapthrough::server::hops
