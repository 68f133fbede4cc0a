/// @file
/// Times, identifiers, the configuration, preferences, log lines.

#include <gmock/gmock.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string_view>
#include <thread>

#include "server/authority.h"
#include "server/bell.h"
#include "server/config.h"
#include "server/environment.h"
#include "server/front/turns.h"
#include "server/jobs/handoff.h"
#include "server/jobs/memory.h"
#include "server/jobs/path_batch.h"
#include "server/jobs/waiting_count.h"
#include "server/log/log.h"
#include "server/resources/negotiation.h"
#include "server/resources/prefer.h"
#include "tests/server/support/samples.h"

namespace snapthrough::server {
namespace {

using testing::ElementsAre;

TEST(Environment, WritesTimes) {
  const Time time(std::chrono::microseconds(1769848200250007));
  EXPECT_EQ(rfc3339(time), "2026-01-31T08:30:00.250007Z");
  EXPECT_EQ(http_date(time), "Sat, 31 Jan 2026 08:30:00 GMT");
  EXPECT_EQ(rfc3339(Time(std::chrono::microseconds(951782400000000))), "2000-02-29T00:00:00.000000Z");
}

TEST(Environment, IdentifiersSortByTimeAndDiffer) {
  const Environment system = Environment::system();
  std::set<std::string> ids;
  for (int i = 0; i < 1000; ++i) {
    const std::string id = new_id(system);
    EXPECT_TRUE(is_id(id)) << id;
    EXPECT_EQ(id[14], '7');
    EXPECT_NE(std::string("89ab").find(id[19]), std::string::npos) << id;
    ids.insert(id);
  }
  EXPECT_EQ(ids.size(), 1000U);
  test::FakeWorld world;
  world.random = 0xFFFFFFFFFFFFFFF0U;
  const std::string early = new_id(world.environment());
  world.microseconds += 1000;
  world.random = 0;
  EXPECT_LT(early, new_id(world.environment()));
}

TEST(Environment, KnowsTheFormOfAnIdentifier) {
  EXPECT_TRUE(is_id(test::id_number(1)));
  EXPECT_FALSE(is_id(""));
  EXPECT_FALSE(is_id(test::id_number(1) + "0"));
  EXPECT_FALSE(is_id("00000000-0000-7000-8000-00000000000G"));
  EXPECT_FALSE(is_id("000000000000070000800000000000000001"));
}

TEST(Config, DefaultsAreUsable) { EXPECT_TRUE(ServiceConfig::defaults().check().empty()); }

TEST(Config, NamesTheFieldThatIsWrong) {
  const auto fields = [](auto change) {
    ServiceConfig config = ServiceConfig::defaults();
    change(config);
    std::vector<std::string> names;
    for (const ConfigMistake& mistake : config.check()) {
      EXPECT_FALSE(mistake.detail.empty());
      names.push_back(mistake.field);
    }
    return names;
  };
  EXPECT_THAT(fields([](auto& c) { c.listener.host = "0.0.0.0"; }), ElementsAre("listener.host"));
  EXPECT_THAT(fields([](auto& c) { c.listener.host = "127.evil.example"; }), ElementsAre("listener.host"));
  EXPECT_THAT(fields([](auto& c) { c.listener.port = 65536; }), ElementsAre("listener.port"));
  EXPECT_THAT(fields([](auto& c) { c.listener.threads = 0; }), ElementsAre("listener.threads"));
  EXPECT_THAT(fields([](auto& c) { c.listener.limits.body_bytes = 0; }),
              ElementsAre("listener.limits.body_bytes"));
  EXPECT_THAT(fields([](auto& c) { c.waits.longest_wait = std::chrono::seconds(1); }),
              ElementsAre("waits.longest_wait"));
  EXPECT_THAT(fields([](auto& c) { c.store_path = ""; }), ElementsAre("store_path"));
  EXPECT_THAT(fields([](auto& c) { c.jobs.max_crashes = 0; }), ElementsAre("jobs.max_crashes"));
  EXPECT_THAT(fields([](auto& c) { c.jobs.job_memory = 1000; }), ElementsAre("jobs.job_memory"));
  EXPECT_THAT(fields([](auto& c) { c.workers = 0, c.listener.port = -1; }),
              ElementsAre("listener.port", "workers"));
}

TEST(Config, ReadsAddresses) {
  EXPECT_EQ(parse_address("127.0.0.1:8080"), std::pair(std::string("127.0.0.1"), 8080));
  EXPECT_EQ(parse_address("[::1]:0"), std::pair(std::string("::1"), 0));
  for (const char* wrong : {"", "8080", ":8080", "localhost:", "localhost:x", "localhost:65536",
                            "localhost:-1", "::1:80", "[]:80", "localhost:80 "}) {
    EXPECT_EQ(parse_address(wrong), std::nullopt) << wrong;
  }
}

http::Preferences preferences(std::vector<std::string> values) {
  http::Request request;
  for (std::string& value : values) {
    request.headers.emplace_back("prefer", std::move(value));
  }
  return http::read_preferences(request);
}

TEST(PreferredType, HasTheHighestWeightOfItsMostSpecificRange) {
  static constexpr std::array<std::string_view, 2> kTypes{"application/json", "text/csv"};
  const auto preferred = [](std::string_view accept) {
    const auto best = http::preferred_type(accept, kTypes);
    return best ? static_cast<int>(*best) : -1;
  };
  EXPECT_EQ(preferred("application/json;q=0.5, text/csv"), 1);
  EXPECT_EQ(preferred("text/csv;q=0.8, */*;q=0.9"), 0);
  EXPECT_EQ(preferred("text/*;q=0.9, application/*;q=0.1"), 1);
  EXPECT_EQ(preferred("text/csv;q=0, */*"), 0);
  EXPECT_EQ(preferred("application/json;q=0, */*"), 1);
  EXPECT_EQ(preferred("text/csv, application/json"), 0) << "alike: the first that is offered";
  EXPECT_EQ(preferred("image/png"), -1);
  EXPECT_EQ(preferred("application/json;q=0.0"), -1);
}

std::uint64_t passed(http::Turns& turns, const std::string& party) {
  const auto next = turns.pass(party);
  return next ? next->who : 0;
}

TEST(Turns, GoToThoseWhoWaitInTheirOrder) {
  http::Turns turns(2, 2);
  EXPECT_TRUE(turns.take(1, "a"));
  EXPECT_TRUE(turns.take(2, "a"));
  EXPECT_FALSE(turns.take(3, "a"));
  EXPECT_FALSE(turns.take(4, "a"));
  EXPECT_EQ(passed(turns, "a"), 3U);
  EXPECT_FALSE(turns.take(5, "a"));
  EXPECT_EQ(passed(turns, "a"), 4U);
  EXPECT_EQ(passed(turns, "a"), 5U);
  EXPECT_EQ(passed(turns, "a"), 0U);
  EXPECT_EQ(passed(turns, "a"), 0U);
  EXPECT_TRUE(turns.take(6, "a"));
  EXPECT_TRUE(turns.take(7, "a"));
  EXPECT_FALSE(turns.take(8, "a"));
}

TEST(Turns, OnePartyLeavesSomeToOthers) {
  http::Turns turns(3, 2);
  EXPECT_TRUE(turns.take(1, "a"));
  EXPECT_TRUE(turns.take(2, "a"));
  EXPECT_FALSE(turns.take(3, "a")) << "it has its part, although a turn is free";
  EXPECT_TRUE(turns.take(4, "b"));
  EXPECT_EQ(passed(turns, "b"), 0U) << "a still has its part";
  EXPECT_EQ(passed(turns, "a"), 3U);
}

TEST(Turns, PartiesRotate) {
  http::Turns turns(1, 1);
  EXPECT_TRUE(turns.take(1, "a"));
  for (const std::uint64_t who : {2, 3, 4}) {
    EXPECT_FALSE(turns.take(who, "a"));
  }
  EXPECT_FALSE(turns.take(5, "b"));
  EXPECT_FALSE(turns.take(6, "c"));
  EXPECT_EQ(passed(turns, "a"), 2U);
  EXPECT_EQ(passed(turns, "a"), 5U);
  EXPECT_EQ(passed(turns, "b"), 6U);
  EXPECT_EQ(passed(turns, "c"), 3U);
  EXPECT_EQ(passed(turns, "a"), 4U);
  EXPECT_EQ(passed(turns, "a"), 0U);
}

TEST(Bell, ARingBeforeTheSleepIsNotMissedAndSeveralAreOne) {
  using std::chrono_literals::operator""ms;
  Bell bell;
  std::uint64_t seen = 0;
  bell.ring();
  bell.ring();
  EXPECT_TRUE(bell.wait(seen, {}, std::chrono::hours(1)));
  EXPECT_FALSE(bell.wait(seen, {}, 1ms));
  std::jthread other([&] { bell.ring(); });
  EXPECT_TRUE(bell.wait(seen, {}, std::chrono::hours(1)));
}

TEST(Bell, AStopEndsASleep) {
  Bell bell;
  std::uint64_t seen = 0;
  std::stop_source stop;
  std::jthread other([&] { stop.request_stop(); });
  EXPECT_FALSE(bell.wait(seen, stop.get_token(), std::chrono::hours(1)));
  pause(stop.get_token(), std::chrono::hours(1));
}

TEST(Bell, ARingThatAJobOvertakesIsSeenByTheNextWait) {
  using std::chrono_literals::operator""ms;
  HandoffQueue queue;
  Handoff job{{"a", 1, "{}", {}}, {}};
  EXPECT_FALSE(queue.offer(job)) << "no worker is idle";
  std::uint64_t seen = 0;
  std::jthread other([&] {
    while (!queue.offer(job)) {
      std::this_thread::yield();
    }
    queue.ring();
  });
  const std::optional<Handoff> given = queue.wait(seen, {}, std::chrono::hours(1));
  ASSERT_TRUE(given.has_value());
  EXPECT_EQ(given->claim.id, "a");
  other.join();
  EXPECT_FALSE(queue.wait(seen, {}, std::chrono::hours(1)).has_value()) << "the ring ends the wait";
  EXPECT_EQ(seen, 1U);
  EXPECT_EQ(queue.idle(), 0U);
}

TEST(PollBell, IsReadableAfterARingUntilItIsSilenced) {
  const auto readable = [](const PollBell& bell) {
    pollfd waited{bell.descriptor(), POLLIN, 0};
    return ::poll(&waited, 1, 0) == 1;
  };
  const PollBell all;
  const PollBell one_by_one(true);
  EXPECT_FALSE(readable(all));
  for (const PollBell* bell : {&all, &one_by_one}) {
    bell->ring();
    bell->ring();
    EXPECT_TRUE(readable(*bell));
    bell->silence();
  }
  EXPECT_FALSE(readable(all));
  EXPECT_TRUE(readable(one_by_one));
  one_by_one.silence();
  EXPECT_FALSE(readable(one_by_one));
}

TEST(WaitingCount, IsNotRecountedBetweenTheStoresChangeAndItsOwn) {
  WaitingCount count;
  {
    WaitingCount::Change stored(count);
    count.recount([] { return StatusOr<std::int64_t>(0); });
    stored.add(1);
  }
  EXPECT_EQ(count.value(), 1);
  {
    WaitingCount::Change claimed(count);  // the store has claimed its only job, the count has not
    count.recount([] { return StatusOr<std::int64_t>(0); });
    claimed.add(-1);
  }
  EXPECT_EQ(count.value(), 0);
  count.recount([&] {  // one job comes and goes during the query, which sees it
    WaitingCount::Change(count).add(1);
    WaitingCount::Change(count).add(-1);
    return StatusOr<std::int64_t>(1);
  });
  EXPECT_EQ(count.value(), 0);
  count.recount([] { return StatusOr<std::int64_t>(7); });
  EXPECT_EQ(count.value(), 7);
  count.recount([] { return StatusOr<std::int64_t>(Status(StatusCode::unavailable, "")); });
  EXPECT_EQ(count.value(), 7);
}

TEST(LargeDocument, WaitsForAnotherThreadsButNotForItsOwnAndSmallOnesDoNot) {
  constexpr std::size_t kLarge = 1'000'000;
  std::atomic<bool> second = false;
  std::jthread other;
  {
    const LargeDocument first(kLarge);
    const LargeDocument that_it_leads_to(kLarge);
    other = std::jthread([&] {
      const LargeDocument small(100);
      const LargeDocument large(kLarge);
      second = true;
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_FALSE(second);
    std::jthread([] { const LargeDocument small(100); }).join();  // would hang
  }
  other.join();
  EXPECT_TRUE(second);
}

TEST(Authority, PortsAndLoopbackHosts) {
  EXPECT_EQ(Authority::of("[::1]:80").host, "[::1]");
  EXPECT_EQ(Authority::of("[::1]:80").port, "80");
  EXPECT_EQ(Authority::of("[::1]").port, std::nullopt);
  EXPECT_EQ(Authority::of("name:").port, "");
  EXPECT_EQ(read_port("65535"), 65535);
  EXPECT_EQ(read_port("0"), 0);
  for (const char* wrong : {"", "65536", "-1", "+1", "080", "8a", " 80"}) {
    EXPECT_EQ(read_port(wrong), std::nullopt) << wrong;
  }
  for (const char* own : {"localhost", "127.0.0.1", "127.255.0.9", "::1"}) {
    EXPECT_TRUE(is_loopback(own)) << own;
  }
  for (const char* other : {"127.0.0.1.evil.example", "127.1", "128.0.0.1", "evil", "[::1]", ""}) {
    EXPECT_FALSE(is_loopback(other)) << other;
  }
}

TEST(Prefer, ReadsWaitAndAsync) {
  EXPECT_EQ(preferences({}).wait_s, std::nullopt);
  EXPECT_FALSE(preferences({}).respond_async);
  EXPECT_EQ(preferences({"wait=5"}).wait_s, 5);
  EXPECT_TRUE(preferences({"Respond-Async, wait = 7 ; x=y, foo"}).respond_async);
  EXPECT_EQ(preferences({"respond-async, wait = 7 ; x=y, foo"}).wait_s, 7);
  EXPECT_EQ(preferences({"foo", "wait=3", "wait=4"}).wait_s, 3);
}

TEST(Prefer, IgnoresWhatIsMalformed) {
  for (const char* wrong :
       {"wait", "wait=", "wait=x", "wait=-1", "wait=1.5", "waits=1", "wait=99999999999999", ",,;="}) {
    EXPECT_EQ(preferences({wrong}).wait_s, std::nullopt) << wrong;
  }
}

TEST(Log, EachLineIsOneJsonObjectWhateverTheTextHolds) {
  std::ostringstream out;
  test::FakeWorld world;
  Log log(LogLevel::info, world.environment().now, out);
  const std::string nasty = "a\"b\\c\nd\x01\xff\xc3\xa4";
  log.write(LogLevel::info, "request",
            {{"path", std::string_view(nasty)}, {"status", std::int64_t{200}}, {"ok", true}, {"ms", 0.5}});
  const std::string text = out.str();
  ASSERT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  const auto line = nlohmann::json::parse(text);
  EXPECT_EQ(line["event"], "request");
  EXPECT_EQ(line["level"], "info");
  EXPECT_EQ(line["time"], rfc3339(test::at_second(0)));
  EXPECT_EQ(line["status"], 200);
  EXPECT_EQ(line["ok"], true);
  EXPECT_EQ(line["path"], "a\"b\\c\nd\x01\xef\xbf\xbd\xc3\xa4");
}

/// A reader that stalls stopped every thread that wrote a line, requests for /livez among them.
TEST(Log, AReaderThatStallsIsNotWaitedForAndIsToldWhatItMissed) {
  int completions[2] = {-1, -1};
  ASSERT_EQ(::pipe(completions), 0);
  Log log(LogLevel::info, Environment::system().now, completions[1]);
  constexpr int kLines = 5'000;
  const std::string detail(200, 'x');
  for (int i = 0; i < kLines; ++i) {
    log.write(LogLevel::info, "job", {{"number", std::int64_t{i}}, {"detail", std::string_view(detail)}});
  }
  std::string text;
  const auto read_some = [&] {
    std::vector<char> chunk(1 << 20);
    const ssize_t got = ::read(completions[0], chunk.data(), chunk.size());
    text.append(chunk.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  };
  read_some();
  log.write(LogLevel::info, "last", {});
  ::close(completions[1]);
  read_some();
  std::istringstream lines(text);
  int seen = 0;
  std::int64_t lost = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto parsed = nlohmann::json::parse(line);
    seen += parsed["event"] == "job" ? 1 : 0;
    lost += parsed.value("lost_lines", std::int64_t{0});
  }
  EXPECT_GT(seen, 100);
  EXPECT_EQ(seen + lost, kLines);
  EXPECT_THAT(text, testing::HasSubstr("\"event\":\"last\""));
  ::close(completions[0]);
}

TEST(Log, LevelsHoldBack) {
  std::ostringstream out;
  test::FakeWorld world;
  Log log(LogLevel::warning, world.environment().now, out);
  log.write(LogLevel::info, "quiet");
  EXPECT_EQ(out.str(), "");
  log.write(LogLevel::warning, "loud");
  EXPECT_NE(out.str().find("loud"), std::string::npos);
  EXPECT_EQ(log_level_from("error"), LogLevel::error);
  EXPECT_EQ(log_level_from("verbose"), std::nullopt);
}

TEST(PathBatch, LeavesOutWhatItHasNoRoomFor) {
  TracedPoint point;
  for (int i = 0; i < 1000; ++i) {
    point.monitors.push_back({"monitor " + std::to_string(i), 0.5});
  }
  PathBatch batch;
  for (point.step = 0; point.step < 1000; ++point.step) {
    batch.add(point);
  }
  EXPECT_EQ(batch.points().size(), 20U);
  const nlohmann::json document = nlohmann::json::parse(path_points_document(batch.points()));
  EXPECT_EQ(document["step"].back(), 19) << "the first ones are there";
  EXPECT_EQ(document["monitors"].size(), 100U);
  batch.clear();
  batch.add(point);
  EXPECT_EQ(batch.points().size(), 1U) << "there is room again";
}

}  // namespace
}  // namespace snapthrough::server
