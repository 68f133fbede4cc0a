#pragma once
/// @file
/// What a running tool can say to the client, and ask the user through it.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stop_token>
#include <string>

namespace snapthrough::server::mcp {

/// @brief One call of a tool, as the tool sees the client. Used on the thread of the call.
class Dialogue {
 public:
  Dialogue() = default;
  Dialogue(const Dialogue&) = delete;
  Dialogue& operator=(const Dialogue&) = delete;
  Dialogue(Dialogue&&) = delete;
  Dialogue& operator=(Dialogue&&) = delete;
  virtual ~Dialogue() = default;

  /// Requested when the client cancels the call, or ends the session.
  [[nodiscard]] virtual std::stop_token stop() const = 0;
  /// Tells progress, if the client wants to hear of it. @param done larger at each call
  virtual void tell(double done, std::optional<double> total, const std::string& message) = 0;

  /// What came of a question.
  struct Answer {
    enum class Kind { given, refused, impossible };  ///< impossible: the client cannot ask its user
    Kind kind = Kind::impossible;
    std::optional<std::string> content = {};  ///< kind given: a JSON object with the values by name
  };
  /// Asks the user for values. Returns when the user has answered, or the call ends.
  /// @param schema a flat JSON Schema of an object with numbers, texts and truth values
  [[nodiscard]] virtual Answer ask(const std::string& message, const nlohmann::json& schema) = 0;
};

}  // namespace snapthrough::server::mcp
