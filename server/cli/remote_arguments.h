#pragma once
/// @file
/// The arguments of submit, wait and fetch.

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <string_view>

#include "server/cli/remote.h"

namespace snapthrough::server::cli {

/// Where the service is, for those who do not want to write --service each time.
inline constexpr const char* kServiceVariable = "SNAPTHROUGH_SERVICE";
/// Names the file with the key.
inline constexpr const char* kKeyFileVariable = "SNAPTHROUGH_KEY_FILE";

/// Whether a variable of the environment is of these commands, and no setting of the service.
[[nodiscard]] bool is_remote_variable(std::string_view name);

/// What the arguments set.
struct RemoteArguments {
  ServiceOptions service;
  SubmitOptions submit;
  WaitOptions wait;
  FetchOptions fetch;
  std::string document;  ///< path
  std::string id;
  std::function<int(const Streams&)> action;  ///< of the command that was given; empty: none of these
};

/// Adds submit, wait and fetch. @pre the arguments outlive the app
void add_remote_commands(CLI::App& app, RemoteArguments& arguments);

}  // namespace snapthrough::server::cli
