#include "tests/server/support/store_driver.h"

#include "server/store/sqlite/sqlite_store.h"
#include "tests/server/support/samples.h"

namespace snapthrough::server::test {

std::vector<StoreDriver> store_drivers() {
  return {{"Sqlite",
           [](const TempDir& folder) { return sqlite::open_store(folder.file("store.db"), at_second(0)); }}};
}

}  // namespace snapthrough::server::test
