#include "server/jobs/content_key.h"

#include <nlohmann/json.hpp>
#include <string>

#include "api/provenance.h"
#include "server/digest.h"

namespace snapthrough::server {

using nlohmann::json;

std::string content_key(std::string_view canonical) {
  return sha256_hex(std::string("snapthrough " SNAPTHROUGH_VERSION " request 2 ").append(canonical));
}

std::string point_key(const json& document, std::string_view outputs, std::string_view owner) {
  std::string text = "snapthrough " SNAPTHROUGH_VERSION " point 2 ";
  text.append(outputs).append(json(owner).dump(-1, ' ', false, json::error_handler_t::replace));
  text.append(api::canonical_text(document));
  return sha256_hex(text);
}

}  // namespace snapthrough::server
