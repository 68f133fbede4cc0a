#pragma once
/// @file
/// The settings by name, from wherever they come: one table for the configuration file, the environment and
/// the command line.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/config.h"

namespace snapthrough::server {

/// One setting. As `name` in the file, SNAPTHROUGH_NAME in the environment, --name (with dashes) as a flag.
struct Setting {
  std::string name;
  std::string help;
  /// Takes the value; what is wrong with it, or nothing.
  std::function<std::optional<std::string>(ServiceConfig&, const std::string&)> set;
  /// The value in the form that set() takes.
  std::function<std::string(const ServiceConfig&)> get;
};

/// Every setting; keys apart, which only the file has.
[[nodiscard]] const std::vector<Setting>& settings();

/// Where values come from; later ones win: file, environment, flags.
struct SettingSources {
  std::string file;                                ///< TOML; empty: none
  std::map<std::string, std::string> environment;  ///< every variable that begins with kVariablePrefix
  std::vector<std::pair<std::string, std::string>> flags;  ///< by setting name
};

/// Variables of the environment that begin so are settings, or kConfigVariable; others are mistakes.
inline constexpr std::string_view kVariablePrefix = "SNAPTHROUGH_";
/// Names the configuration file.
inline constexpr const char* kConfigVariable = "SNAPTHROUGH_CONFIG";

/// @brief Reads all sources. Every mistake is listed with the place it comes from; the configuration is not
/// to be used then. @param front see ServiceConfig
[[nodiscard]] std::pair<ServiceConfig, std::vector<ConfigMistake>> load_config(const SettingSources& sources,
                                                                               bool front = true);

/// The name of the variable of a setting: SNAPTHROUGH_NAME.
[[nodiscard]] std::string variable_name(const std::string& setting);

}  // namespace snapthrough::server
