#pragma once
/// @file
/// Settings by name: one table for the configuration file, the environment and the command line.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/config.h"

namespace snapthrough::server {

/// A setting: `name` in the file, SNAPTHROUGH_NAME in the environment, --name (with dashes) as a flag.
struct Setting {
  std::string name;
  std::string help;
  /// Sets the value; returns what is wrong with it, or nullopt.
  std::function<std::optional<std::string>(ServiceConfig&, const std::string&)> set;
  /// Returns the value in the format of set().
  std::function<std::string(const ServiceConfig&)> get;
  std::string type = "TEXT";  ///< what help shows in place of the value
};

/// Returns all settings except keys, which only the file can have.
[[nodiscard]] const std::vector<Setting>& settings();

/// Sources of settings in ascending priority: file, environment, flags.
struct SettingSources {
  std::string file;                                        ///< TOML file; empty: none
  std::map<std::string, std::string> environment;          ///< variables that begin with kVariablePrefix
  std::vector<std::pair<std::string, std::string>> flags;  ///< values by setting name
};

/// Prefix of variables that are settings or kConfigVariable; any other variable with it is an error.
inline constexpr std::string_view kVariablePrefix = "SNAPTHROUGH_";
/// Environment variable with the path of the configuration file.
inline constexpr const char* kConfigVariable = "SNAPTHROUGH_CONFIG";

/// @brief Reads all sources. If there are mistakes (each with its source), the configuration must not be
/// used. @param front see ServiceConfig
[[nodiscard]] std::pair<ServiceConfig, std::vector<ConfigMistake>> load_config(const SettingSources& sources,
                                                                               bool front = true);

/// Returns the environment variable of a setting: SNAPTHROUGH_NAME.
[[nodiscard]] std::string variable_name(const std::string& setting);

}  // namespace snapthrough::server
