/// @file
/// A store that is away for a time: how it is told, and how often.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "server/store/postgresql/connection.h"
#include "tests/server/support/eventually.h"
#include "tests/server/support/running_service.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// Returns the lines of a log (JSON) whose member `event` has a value.
std::vector<json> lines(const std::string& text, const std::string& event) {
  std::vector<json> found;
  std::istringstream log(text);
  for (std::string line; std::getline(log, line);) {
    if (const json document = json::parse(line); document["event"] == event) {
      found.push_back(document);
    }
  }
  return found;
}

TEST(Log, WhatIsAwayIsToldAtItsBeginAndItsEnd) {
  SharedText text;
  std::ostream stream(&text);
  Log log(LogLevel::info, Environment::system().now, stream);
  log.is_back("store");
  log_store_trouble(log, {StatusCode::unavailable, "no route"});
  log_store_trouble(log, {StatusCode::unavailable, "refused"});
  log_store_trouble(log, {StatusCode::io_error, "damaged"});
  log.is_back("store");
  log.is_back("store");
  log_store_trouble(log, {StatusCode::unavailable, "again"});
  const std::vector<json> told = lines(text.text(), "store");
  ASSERT_EQ(told.size(), 4U) << text.text();
  EXPECT_EQ(told[0]["detail"], "no route");
  EXPECT_EQ(told[1]["detail"], "damaged");
  EXPECT_EQ(told[2]["failures"], 2);
  EXPECT_EQ(told[2]["level"], "info");
  EXPECT_EQ(told[3]["detail"], "again");
}

/// A database that a role of the test's own uses, which can be shut out.
class StoreAway : public ServiceTest {
 protected:
  void SetUp() override {
    const std::string location = postgresql_location(folder_.name());
    admin_ = std::make_unique<postgresql::Connection>(location);
    admin_->execute("CREATE ROLE " + role_ + " LOGIN; GRANT ALL ON SCHEMA \"" + folder_.name() + "\" TO " +
                    role_);
    ServiceConfig away = config();
    away.store_path = location;
    away.store_path.replace(location.find("snapthrough@"), 11, folder_.name());
    service_ = std::make_unique<Service>(away, Environment::system(), local_runners(quick), log_);
    const Status status = service_->start();
    ASSERT_TRUE(status.ok()) << status.message();
  }
  void TearDown() override {
    service_.reset();
    admin_->execute("ALTER ROLE " + role_ + " NOLOGIN; DROP OWNED BY " + role_ + "; DROP ROLE " + role_);
  }
  void shut_out() {
    admin_->execute("ALTER ROLE " + role_ + " NOLOGIN");
    admin_->execute("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE usename = '" +
                    folder_.name() + "'");
  }
  void let_in() { admin_->execute("ALTER ROLE " + role_ + " LOGIN"); }
  static Result quick(const Model&, const Analysis&, const Hooks&) { return {}; }
  [[nodiscard]] int ready() const { return get(port(), "/readyz").status; }

  std::unique_ptr<postgresql::Connection> admin_;
  const std::string role_ = "\"" + folder_.name() + "\"";
};

TEST_F(StoreAway, IsNoFullDiskAndIsToldOnce) {
  ASSERT_TRUE(eventually([&] { return ready() == 200; }));
  shut_out();
  ASSERT_TRUE(eventually(
      [&] { return get(port(), "/readyz").body.find("The store can't be written.") != std::string::npos; }));
  EXPECT_THAT(get(port(), "/metrics").body, HasSubstr("\nsnapthrough_disk_has_space 1"));
  std::this_thread::sleep_for(std::chrono::seconds(3));  // some rounds of all who use the store
  std::vector<json> told = lines(log_text_.text(), "store");
  ASSERT_EQ(told.size(), 1U) << log_text_.text();
  EXPECT_THAT(told[0]["detail"].get<std::string>(), Not(HasSubstr("disk")));
  let_in();
  ASSERT_TRUE(eventually([&] { return ready() == 200; }));
  told = lines(log_text_.text(), "store");
  ASSERT_EQ(told.size(), 2U) << log_text_.text();
  EXPECT_EQ(told[1]["detail"], "can be used again");
  EXPECT_TRUE(lines(log_text_.text(), "disk").empty());
}

}  // namespace
}  // namespace snapthrough::server::test
