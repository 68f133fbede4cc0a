#include "server/store/postgresql/postgresql_store.h"

#include <utility>

#include "server/store/postgresql/jobs.h"
#include "server/store/postgresql/migrations.h"

namespace snapthrough::server::postgresql {

bool is_location(const std::string& location) {
  return location.starts_with("postgresql://") || location.starts_with("postgres://");
}

std::string without_password(const std::string& location) {
  const std::size_t authority = location.find("://") + 3;
  const std::size_t end = std::min(location.find('/', authority), location.size());
  const std::size_t at = location.rfind('@', end);
  const std::size_t colon = location.find(':', authority);
  if (!is_location(location) || at == std::string::npos || at < authority || colon > at) {
    return location;
  }
  return location.substr(0, colon) + location.substr(at);
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
  return std::unique_ptr<Store>(
      std::make_unique<PostgresqlStore>(location, options.connections, Clock(options.time_of_caller)));
}

}  // namespace snapthrough::server::postgresql
