/// @file
/// Owners whose callbacks go to the same host.

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/server/support/owners.h"
#include "tests/server/support/receiver.h"
#include "tests/server/support/running_service.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;

TEST_F(ServiceTest, AnOwnersHangingReceiverDoesNotDelayTheCallbacksOfAnother) {
  Receiver receiver([](int number) { return number < 2 ? std::string() : response(200); });
  ServiceConfig telling = config();
  telling.keys = ann_and_bob();
  telling.jobs.callback_hosts = {receiver.host()};
  telling.callback_secret_file = folder_.file("secret");
  std::ofstream(telling.callback_secret_file) << "whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw\n";
  telling.callback_times.attempt = std::chrono::hours(1);
  telling.callback_times.poll = std::chrono::milliseconds(10);
  service_ = std::make_unique<Service>(
      telling, Environment::system(),
      local_runners([](const Model&, const Analysis&, const Hooks&) { return Result(); }), log_);
  ASSERT_TRUE(service_->start().ok());
  const auto add = [&](const std::string& title, const std::string& key) {
    const Reply reply =
        post(port(), "/v1/jobs",
             "{\"callback\": \"" + receiver.address() + "\", \"request\": " + column_request(title) + "}",
             {"Content-Type: application/json", "Prefer: return=minimal, wait=20",
              "Authorization: Bearer " + key});
    EXPECT_EQ(reply.status, 201) << reply.body;
    return json::parse(reply.body)["id"].get<std::string>();
  };
  for (int i = 0; i < 9; ++i) {
    add("ann " + std::to_string(i), "alice");
  }
  ASSERT_EQ(receiver.wait_for(2).size(), 2U) << "both hang";
  const std::string bobs = add("bob", "bob");
  const std::vector<Told> told = receiver.wait_for(3);
  ASSERT_EQ(told.size(), 3U);
  EXPECT_EQ(json::parse(told[2].body)["id"], bobs);
  service_.reset();  // the receiver holds its connections until the service closes them
}

}  // namespace
}  // namespace snapthrough::server::test
