#pragma once
/// @file
/// Requests that occupy a thread of the front.

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/server/support/client.h"
#include "tests/server/support/samples.h"

namespace snapthrough::server::test {

/// A request that takes a second and more to check for each 30 members: each curve has a table of its length.
/// @param count number of members, of some 180 bytes each
inline std::string costly_request(int count = 2000) {
  using nlohmann::json;
  json request = json::parse(column_request());
  json nodes = json::array({{{"id", "n0"}, {"x", 0}, {"y", 0}}});
  json members = json::array();
  for (int i = 0; i < count; ++i) {
    const std::string end = "n" + std::to_string(i + 1);
    nodes.push_back({{"id", end}, {"x", i + 1}, {"y", 0}});
    members.push_back({{"id", "m" + std::to_string(i)},
                       {"start", "n" + std::to_string(i)},
                       {"end", end},
                       {"section", request["model"]["sections"][0]["id"]},
                       {"curve", {{"type", "sine"}, {"rise", 0.01}, {"half_waves", 1000}}}});
  }
  request["model"] = {
      {"nodes", nodes},
      {"sections", request["model"]["sections"]},
      {"members", members},
      {"supports", {{{"node", "n0"}, {"fixed", {"x", "y", "rotation"}}}}},
      {"loads", {{{"type", "point"}, {"at", {{"node", "n" + std::to_string(count)}}}, {"force", {-1, 0}}}}}};
  return request.dump();
}

/// Returns the bytes of a POST. @param announced Content-Length, if more than the body has
inline std::string posted(const std::string& target, const std::string& body, const Headers& headers,
                          std::size_t announced = 0) {
  std::string text = "POST " + target + " HTTP/1.1\r\nHost: localhost\r\n";
  for (const std::string& header : headers) {
    text += header + "\r\n";
  }
  return text + "Content-Length: " + std::to_string(std::max(announced, body.size())) + "\r\n\r\n" + body;
}

}  // namespace snapthrough::server::test
