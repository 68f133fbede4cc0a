#pragma once
/// @file
/// Command-line arguments of submit, wait and fetch.

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <string_view>

#include "server/cli/remote.h"
#include "server/cli/streams.h"

namespace snapthrough::server::cli {

/// Environment variable that stands for --service.
inline constexpr const char* kServiceVariable = "SNAPTHROUGH_SERVICE";
/// Environment variable that stands for --key-file.
inline constexpr const char* kKeyFileVariable = "SNAPTHROUGH_KEY_FILE";

/// Returns whether a variable belongs to these commands and is no setting of the service.
[[nodiscard]] bool is_remote_variable(std::string_view name);

/// Values of the arguments of submit, wait and fetch.
struct RemoteArguments {
  ServiceOptions service;
  SubmitOptions submit;
  WaitOptions wait;
  FetchOptions fetch;
  std::string document;  ///< path of the document
  std::string id;
  std::function<int(const Streams&)> action;  ///< action of the given command; empty: another command
};

/// Adds submit, wait and fetch. @pre the arguments outlive the app
void add_remote_commands(CLI::App& app, RemoteArguments& arguments);

}  // namespace snapthrough::server::cli
