#include <nlohmann/json.hpp>

#include "api/convert/convert.h"

namespace snapthrough::api {

std::string write_parts(const nlohmann::json& parts) { return parts.dump(2) + "\n"; }

}  // namespace snapthrough::api
