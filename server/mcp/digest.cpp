#include "server/mcp/digest.h"

#include <nlohmann/json.hpp>
#include <string>

#include "solver/model/pointer.h"

namespace snapthrough::server::mcp {
namespace {

using nlohmann::json;

/// Copies a value without its long lists, whose pointers are added to `left_out`.
json shortened(const json& value, const std::string& pointer, std::size_t most, json& left_out) {
  if (value.is_object()) {
    json copy = json::object();
    for (const auto& [name, member] : value.items()) {
      const std::string place = pointer + "/" + escape_pointer_token(name);
      if (member.is_array() && member.size() > most) {
        left_out.push_back({{"pointer", place}, {"items", member.size()}});
      } else {
        copy[name] = shortened(member, place, most, left_out);
      }
    }
    return copy;
  }
  if (value.is_array()) {
    json copy = json::array();
    for (std::size_t i = 0; i < value.size(); ++i) {
      copy.push_back(shortened(value[i], pointer + "/" + std::to_string(i), most, left_out));
    }
    return copy;
  }
  return value;
}

}  // namespace

json digest_of(const json& document, std::size_t most) {
  json left_out = json::array();
  json copy = shortened(document, "", most, left_out);
  if (!left_out.empty()) {
    copy["left_out"] = std::move(left_out);
  }
  return copy;
}

}  // namespace snapthrough::server::mcp
