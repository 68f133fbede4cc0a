#include "tests/server/support/store_driver.h"

#include "server/store/postgresql/postgresql_store.h"
#include "server/store/sqlite/sqlite_store.h"
#include "tests/server/support/postgresql.h"
#include "tests/server/support/samples.h"

namespace snapthrough::server::test {

std::vector<StoreDriver> store_drivers() {
  const auto sqlite = [](const TempDir& folder) {
    return sqlite::open_store(folder.file("store.db"), at_second(0));
  };
  const auto postgresql = [](const TempDir& folder) {
    postgresql::Options options;
    options.time_of_caller = true;
    return postgresql::open_store(postgresql_location(folder.name()), options);
  };
  return {{"Sqlite", sqlite, false}, {"Postgresql", postgresql, true}};
}

}  // namespace snapthrough::server::test
