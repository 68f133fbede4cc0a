#include "server/key_settings.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <string_view>

namespace snapthrough::server {
namespace {

using http::Scope;
using http::Scopes;

constexpr std::array<std::string_view, 4> kMembers{"owner", "sha256", "expires", "scopes"};

Time midnight(const toml::date& date) {
  return std::chrono::sys_days(std::chrono::year(date.year) / date.month / date.day);
}

/// Returns the time that `expires` stands for; nullopt for a node of another kind.
std::optional<Time> time_of(const toml::node& node) {
  if (const toml::value<toml::date>* date = node.as_date()) {
    return midnight(date->get());
  }
  const toml::value<toml::date_time>* given = node.as_date_time();
  if (given == nullptr || !given->get().offset) {
    return std::nullopt;
  }
  const toml::date_time& moment = given->get();
  const std::chrono::nanoseconds fraction(moment.time.nanosecond);
  return midnight(moment.date) + std::chrono::hours(moment.time.hour) +
         std::chrono::minutes(moment.time.minute) + std::chrono::seconds(moment.time.second) +
         std::chrono::floor<std::chrono::microseconds>(fraction) -
         std::chrono::minutes(moment.offset->minutes);
}

/// Reads one table; `wrong(node, member, rule)` is called for each mistake.
template <class Wrong>
class KeyReader {
 public:
  KeyReader(const toml::table& table, const Wrong& wrong) : table_(table), wrong_(wrong) {}

  /// Returns the key; of no use when there was a mistake.
  http::ApiKey read() {
    for (const auto& [name, node] : table_) {
      if (std::find(kMembers.begin(), kMembers.end(), name.str()) == kMembers.end()) {
        wrong_(node, name.str(), "there is no such member; a key has owner, sha256, expires and scopes");
      }
    }
    http::ApiKey key{text("owner"), text("sha256")};
    if (const toml::node* expires = table_.get("expires")) {
      key.expires = time_of(*expires);
      if (!key.expires) {
        wrong_(*expires, "expires",
               "expected a date-time with an offset, such as 2027-03-31T00:00:00Z, or a date, such as "
               "2027-03-31, which stands for its midnight in UTC, both without quotation marks");
      }
    }
    if (const toml::node* scopes = table_.get("scopes")) {
      read_scopes(*scopes, key.scopes);
    }
    return key;
  }

 private:
  std::string text(const char* member) {
    const toml::node* node = table_.get(member);
    if (node == nullptr || !node->is_string()) {
      wrong_(node == nullptr ? static_cast<const toml::node&>(table_) : *node, member, "expected a text");
      return "";
    }
    return **node->as_string();
  }

  void read_scopes(const toml::node& node, Scopes& scopes) {
    static constexpr std::string_view kRule =
        "expected a list with one or more of \"read\", \"submit\" and \"metrics\"; without scopes a key has "
        "all three";
    const toml::array* list = node.as_array();
    if (list == nullptr || list->empty()) {
      wrong_(node, "scopes", kRule);
      return;
    }
    scopes = {};
    for (const toml::node& entry : *list) {
      const auto scope = http::scope_from(entry.value<std::string_view>().value_or(""));
      if (scope) {
        scopes.add(*scope);
      } else {
        wrong_(entry, "scopes", kRule);
      }
    }
  }

  const toml::table& table_;
  const Wrong& wrong_;
};

}  // namespace

std::string place(const std::string& file, const toml::node& node) {
  return file + ":" + std::to_string(node.source().begin.line);
}

void read_keys(const toml::node& node, const std::string& file, std::vector<http::ApiKey>& keys,
               std::vector<ConfigMistake>& mistakes) {
  const toml::array* list = node.as_array();
  if (list == nullptr || (!list->empty() && !list->is_homogeneous(toml::node_type::table))) {
    mistakes.push_back({place(file, node), "keys: expected [[keys]] tables"});
    return;
  }
  for (const toml::node& entry : *list) {
    const toml::table& table = *entry.as_table();
    const std::string owner = table["owner"].value<std::string>().value_or("?");
    const std::size_t before = mistakes.size();
    const auto wrong = [&](const toml::node& where, std::string_view member, std::string_view rule) {
      mistakes.push_back(
          {place(file, where) + ": keys, owner " + owner + ", " + std::string(member), std::string(rule)});
    };
    http::ApiKey key = KeyReader(table, wrong).read();
    if (mistakes.size() == before) {
      keys.push_back(std::move(key));
    }
  }
}

}  // namespace snapthrough::server
