#pragma once
/// @file
/// The tools that a language model calls: check, solve, sweep, read, plot, convert.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/mcp/dialogue.h"
#include "server/mcp/shelf.h"
#include "server/worker/runner.h"
#include "solver/model/finding.h"

namespace snapthrough::server::mcp {

/// Bounds of what one call answers with: a reader has little room.
inline constexpr std::size_t kMostItems = 12;         ///< largest list that a result shows whole
inline constexpr std::size_t kMostRows = 200;         ///< rows or items that one call returns
inline constexpr std::uint64_t kMostPoints = 10'000;  ///< points of one sweep

/// What tools need of the program around them.
struct Surroundings {
  RunnerFactory make;  ///< makes what computes, at the first call that needs it
  /// Writes a figure (SVG) as PNG. Returns why it cannot; "" after success.
  std::function<std::string(const std::string& svg, std::string& png)> to_png;
};

/// @brief The tools of one session, with the documents that they have made. Used on one thread.
class Tools {
 public:
  explicit Tools(Surroundings around) : around_(std::move(around)) {}

  /// Returns whether there is a tool of that name.
  [[nodiscard]] static bool has(std::string_view name);

  /// @brief Calls a tool and returns MCP's CallToolResult. Mistakes of the arguments and failed analyses are
  /// results with `isError`.
  /// @param arguments an object @pre has(name)
  [[nodiscard]] nlohmann::json call(std::string_view name, const nlohmann::json& arguments,
                                    Dialogue& dialogue);

  nlohmann::json check(const nlohmann::json& arguments, Dialogue& dialogue);
  nlohmann::json solve(const nlohmann::json& arguments, Dialogue& dialogue);
  nlohmann::json sweep(const nlohmann::json& arguments, Dialogue& dialogue);
  nlohmann::json read(const nlohmann::json& arguments, Dialogue& dialogue);
  nlohmann::json plot(const nlohmann::json& arguments, Dialogue& dialogue);
  nlohmann::json convert(const nlohmann::json& arguments, Dialogue& dialogue);

 private:
  Runner& runner();

  Surroundings around_;
  std::unique_ptr<Runner> runner_;
  Shelf shelf_;
  int sweeps_ = 0;  ///< that were begun
};

/// Returns the list of tools with the schemas of their arguments (MCP's Tool).
[[nodiscard]] nlohmann::json tool_list();

/// Returns a CallToolResult with a document as text.
[[nodiscard]] nlohmann::json told(const nlohmann::json& document);
/// Returns a CallToolResult that tells why there is no other, with `isError`.
[[nodiscard]] nlohmann::json failed(const nlohmann::json& document);
/// Returns failed() with the mistakes of the arguments.
[[nodiscard]] nlohmann::json refused(const std::vector<Finding>& findings);

}  // namespace snapthrough::server::mcp
