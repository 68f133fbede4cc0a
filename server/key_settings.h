#pragma once
/// @file
/// The [[keys]] tables of the configuration file.

#include <string>
#include <vector>

#include <toml++/toml.h>

#include "server/config.h"

namespace snapthrough::server {

/// Returns the place of a node: "<file>:<line>".
[[nodiscard]] std::string place(const std::string& file, const toml::node& node);

/// @brief Appends the keys of the member `keys` of a file, and the mistakes in it, each with its place, the
/// owner of the key and the rule. Each table has `owner` and `sha256`, and may have `expires` (a date-time
/// with an offset, or a date, which stands for its midnight in UTC) and `scopes` (see http::Scope; all when
/// absent).
void read_keys(const toml::node& node, const std::string& file, std::vector<http::ApiKey>& keys,
               std::vector<ConfigMistake>& mistakes);

}  // namespace snapthrough::server
