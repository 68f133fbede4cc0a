#include "server/store/postgresql/postgresql_store.h"

#include <regex>
#include <utility>

#include "server/store/postgresql/parts.h"

namespace snapthrough::server::postgresql {

bool is_location(const std::string& location) {
  return location.starts_with("postgresql://") || location.starts_with("postgres://");
}

std::string without_password(const std::string& location) {
  if (!is_location(location)) {
    return location;
  }
  // postgresql://user:password@host/name?password=...&sslpassword=...
  static const std::regex kOfUser("^([a-z]+://[^/?@:]*):[^/?@]*@");
  static const std::regex kParameter("([?&][a-z]*password=)[^&]*");
  return std::regex_replace(std::regex_replace(location, kOfUser, "$1@"), kParameter, "$1");
}

StatusOr<std::unique_ptr<Store>> open_store(const std::string& location, const Options& options,
                                            std::span<const Migration> migrations) {
  const auto explained = [&](const Status& status) {
    return Status(status.code(), without_password(location) + ": " + status.message());
  };
  try {
    Connection connection(location);
    if (const Status status = migrate(connection, migrations); !status.ok()) {
      return explained(status);
    }
  } catch (const Error& error) {
    return explained(to_status(error));
  }
  return jobs_in(location, options.connections, Clock(options.time_of_caller));
}

}  // namespace snapthrough::server::postgresql
