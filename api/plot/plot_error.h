#pragma once
/// @file
/// The error of a document or of choices that do not give a figure.

#include <stdexcept>
#include <string>

namespace snapthrough::api {

/// @brief The document or the choices do not give a figure.
class PlotError : public std::runtime_error {
 public:
  /// @param pointer JSON Pointer into the document, or into the solved request when it begins with "request:"
  /// @param rule the rule that the value breaks, as a sentence
  PlotError(std::string pointer, std::string rule);
  [[nodiscard]] const std::string& pointer() const { return pointer_; }
  [[nodiscard]] const std::string& rule() const { return rule_; }

 private:
  std::string pointer_;
  std::string rule_;
};

}  // namespace snapthrough::api
