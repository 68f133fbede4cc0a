#pragma once
/// @file
/// Requests that occupy a thread of the front.

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/server/support/client.h"
#include "tests/server/support/samples.h"

namespace snapthrough::server::test {

/// A request of 2 MB that takes some seconds to check: the lengths of splines through as many points as a
/// document may have.
inline std::string costly_request() {
  using nlohmann::json;
  constexpr int kMembers = 32;
  constexpr int kPoints = 10'000;  // of a spline, as many as there may be
  json request = json::parse(column_request());
  json points = json::array();
  for (int i = 0; i < kPoints; ++i) {
    points.push_back({i % 2, 1});
  }
  json nodes = json::array({{{"id", "n0"}, {"x", 0}, {"y", 0}}});
  json members = json::array();
  for (int i = 0; i < kMembers; ++i) {
    const std::string end = "n" + std::to_string(i + 1);
    nodes.push_back({{"id", end}, {"x", i + 1}, {"y", 0}});
    members.push_back({{"id", "m" + std::to_string(i)},
                       {"start", "n" + std::to_string(i)},
                       {"end", end},
                       {"section", request["model"]["sections"][0]["id"]},
                       {"curve", {{"type", "points"}, {"points", points}}}});
  }
  request["model"] = {
      {"nodes", nodes},
      {"sections", request["model"]["sections"]},
      {"members", members},
      {"supports", {{{"node", "n0"}, {"fixed", {"x", "y", "rotation"}}}}},
      {"loads",
       {{{"type", "point"}, {"at", {{"node", "n" + std::to_string(kMembers)}}}, {"force", {-1, 0}}}}}};
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
