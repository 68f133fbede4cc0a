#pragma once
/// @file
/// Grasshopper components of the service: functions of named values, each call of which is one analysis.

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "api/component.h"

namespace snapthrough::server::hops {

/// Outcome of applying a definition to values of its inputs.
struct Call {
  std::vector<Finding> findings;  ///< pointers are "/" and an input's name
  std::string request;            ///< request document; empty exactly when there are findings
};

/// @brief A component. Immutable, hence thread-safe.
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
  /// Returns the input that writes a place of the request, a part or a container of it; "": none.
  [[nodiscard]] virtual std::string input_at(std::string_view pointer) const = 0;
  /// Returns the members of the result document that values() needs; empty: all.
  [[nodiscard]] virtual std::vector<std::string> parts() const = 0;
  /// Returns the outputs' values in a result, in their order. @param result has at least parts()
  [[nodiscard]] virtual std::vector<api::ComponentValue> values(const nlohmann::json& result) const = 0;
};

/// Returns the definition of a sweep document.
[[nodiscard]] std::shared_ptr<const Definition> sweep_definition(api::Component component);

/// @brief Returns the definition with a request document as input and the common values of results as output.
/// @param example initial value of the input
[[nodiscard]] std::shared_ptr<const Definition> request_definition(std::string_view example);

}  // namespace snapthrough::server::hops
