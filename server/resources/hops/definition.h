#pragma once
/// @file
/// Components of Grasshopper that the service has: functions from named values to named values, each call of
/// which is one analysis.

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "api/component.h"

namespace snapthrough::server::hops {

/// What a definition makes of the values of its inputs.
struct Call {
  std::vector<Finding> findings;  ///< pointers are "/" and the name of an input
  std::string request;            ///< request document; empty exactly when there are findings
};

/// @brief A component. Immutable, so it may be used by several threads.
class Definition {
 public:
  Definition() = default;
  Definition(const Definition&) = delete;
  Definition& operator=(const Definition&) = delete;
  Definition(Definition&&) = delete;
  Definition& operator=(Definition&&) = delete;
  virtual ~Definition() = default;

  [[nodiscard]] virtual std::string description() const = 0;
  [[nodiscard]] virtual const std::vector<api::ComponentInput>& inputs() const = 0;
  [[nodiscard]] virtual const std::vector<api::ComponentOutput>& outputs() const = 0;
  /// @param values by name of the input, each of the input's type; some may be missing
  [[nodiscard]] virtual Call call(const std::map<std::string, nlohmann::json>& values) const = 0;
  /// The input that is written to a place of the request, or around it; empty: none.
  [[nodiscard]] virtual std::string input_at(std::string_view pointer) const = 0;
  /// Members of the result document that values() looks into; none: all of them.
  [[nodiscard]] virtual std::vector<std::string> parts() const = 0;
  /// What a result gives for the outputs, in their order. @param result with at least parts()
  [[nodiscard]] virtual std::vector<api::ComponentValue> values(const nlohmann::json& result) const = 0;
};

/// The definition that a sweep document is.
[[nodiscard]] std::shared_ptr<const Definition> sweep_definition(api::Component component);

/// @brief The definition with one input, a request document as a text, and what every result has as outputs.
/// @param example the request that the input has at the beginning
[[nodiscard]] std::shared_ptr<const Definition> request_definition(std::string_view example);

}  // namespace snapthrough::server::hops
