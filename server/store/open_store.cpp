#include "server/store/open_store.h"

#include "server/store/postgresql/postgresql_store.h"
#include "server/store/sqlite/sqlite_store.h"

namespace snapthrough::server {

bool is_shared_location(const std::string& location) { return postgresql::is_location(location); }

std::string shown_location(const std::string& location) { return postgresql::without_password(location); }

StatusOr<std::unique_ptr<Store>> open_store(const std::string& location, int connections, Time now,
                                            bool time_of_caller) {
  if (!is_shared_location(location)) {
    return sqlite::open_store(location, now);
  }
  postgresql::Options options;
  options.connections = connections;
  options.time_of_caller = time_of_caller;
  return postgresql::open_store(location, options);
}

}  // namespace snapthrough::server
