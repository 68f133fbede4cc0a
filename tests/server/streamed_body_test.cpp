/// @file
/// Tables and results that are read from the store while they are sent: whole, in little memory, for as long
/// as the client reads.

#include <gmock/gmock.h>
#include <zlib.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "tests/server/support/running_service.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using namespace std::chrono_literals;

constexpr int kPoints = 400;
constexpr std::size_t kText = 20'000;  ///< of one row

/// Gives each row a long text; the point with EI 7 fails as long as it is told to.
struct LongTexts {
  std::atomic<bool> failing = false;
  Result operator()(const Model& model, const Analysis&, const Hooks&) const {
    Result result;
    if (failing && model.sections.front().EI == 7.0) {
      result.failure = Failure{"no_convergence", "as it was told"};
    }
    result.summary.critical_load_factor = model.sections.front().EI.constant;
    result.summary.termination = std::string(kText, 'x');
    return result;
  }
};

std::string unpacked(const std::string& packed) {
  z_stream stream{};
  EXPECT_EQ(::inflateInit2(&stream, 15 + 16), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string text(2 * kPoints * kText, '\0');
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  EXPECT_EQ(::inflate(&stream, Z_FINISH), Z_STREAM_END);
  text.resize(stream.total_out);
  ::inflateEnd(&stream);
  return text;
}

class StreamedBody : public ServiceTest {
 protected:
  void start_with(std::chrono::milliseconds send, std::size_t buffered_bytes) {
    ServiceConfig changed = config();
    changed.listener.times.send = send;
    changed.listener.limits.buffered_bytes = buffered_bytes;
    service_ = std::make_unique<Service>(
        changed, Environment::system(),
        local_runners([texts = texts_](const Model& model, const Analysis& analysis, const Hooks& hooks) {
          return (*texts)(model, analysis, hooks);
        }),
        log_);
    ASSERT_TRUE(service_->start().ok());
    const Reply reply = post(port(), "/v1/sweeps", column_sweep(kPoints));
    sweep_ = reply.header("Location");
    for (int i = 0; i < 5 && json::parse(get(port(), sweep_).body)["progress"] != 100; ++i) {
      get(port(), sweep_, {"Prefer: wait=60"});
    }
  }
  [[nodiscard]] double metric(const std::string& name) const {
    const std::string text = get(port(), "/metrics").body;
    const std::size_t at = text.find("\n" + name + " ");
    return at == std::string::npos ? -1.0 : std::stod(text.substr(at + name.size() + 2));
  }
  /// Asks for the table and reads nothing.
  std::unique_ptr<Socket> stalled(const std::string& path) const {
    auto socket = std::make_unique<Socket>(port());
    socket->send("GET " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
    return socket;
  }
  /// How many requests for the table were answered, to the end or not.
  [[nodiscard]] int tables_begun() const {
    const std::string log = log_text_.text();
    int count = 0;
    for (std::size_t at = 0; (at = log.find(kTableRoute, at)) != std::string::npos; ++at) {
      ++count;
    }
    return count;
  }
  static constexpr const char* kTableRoute = R"("route":"/v1/sweeps/{id}/table")";

  std::shared_ptr<LongTexts> texts_ = std::make_shared<LongTexts>();
  std::string sweep_;
};

TEST_F(StreamedBody, ALargeTableIsTheSameInEveryFormAndPackedOrNot) {
  start_with(1h, 64 << 20);
  const Reply table = get(port(), sweep_ + "/table");
  EXPECT_EQ(table.header("Transfer-Encoding"), "chunked");
  EXPECT_EQ(table.header("Content-Length"), "");
  EXPECT_EQ(table.header("X-Complete"), "true");
  ASSERT_TRUE(table.whole);
  const json document = json::parse(table.body);
  ASSERT_EQ(document["rows"].size(), kPoints);
  EXPECT_EQ(document["points"].back(), kPoints - 1);
  EXPECT_EQ(document["rows"][kPoints - 1][2].get<std::string>().size(), kText);
  const Reply packed = get(port(), sweep_ + "/table", {"Accept-Encoding: gzip"});
  ASSERT_TRUE(packed.whole);
  EXPECT_EQ(packed.header("Content-Encoding"), "gzip");
  EXPECT_EQ(unpacked(packed.body), table.body);
  const std::string tag = table.header("ETag");
  EXPECT_EQ(packed.header("ETag"), tag.substr(0, tag.size() - 1) + "-gzip\"");
  const std::string lines = get(port(), sweep_ + "/table?format=ndjson&first=100&count=200").body;
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 200);
  const std::string csv = get(port(), sweep_ + "/table?format=csv").body;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), kPoints + 1);
  const Reply small = get(port(), sweep_ + "/table?count=2");
  EXPECT_EQ(small.header("Content-Length"), std::to_string(small.body.size()));
}

TEST_F(StreamedBody, AConnectionServesOnAfterATableAndAnOldClientGetsItPlain) {
  start_with(1h, 64 << 20);
  Socket socket(port());
  for (int i = 0; i < 2; ++i) {
    socket.send("GET " + sweep_ + "/table HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_EQ(json::parse(socket.receive().body)["rows"].size(), kPoints);
  }
  Socket old(port());
  old.send("GET " + sweep_ + "/table HTTP/1.0\r\n\r\n");
  const std::string text = old.rest();
  EXPECT_THAT(text.substr(0, 1000), testing::Not(HasSubstr("chunked")));
  EXPECT_EQ(json::parse(text.substr(text.find("\r\n\r\n") + 4))["rows"].size(), kPoints);
}

TEST_F(StreamedBody, ClientsThatDoNotReadHoldAPieceEach) {
  start_with(1h, 64 << 20);
  std::vector<std::unique_ptr<Socket>> clients;
  for (int i = 0; i < 8; ++i) {
    clients.push_back(stalled(sweep_ + "/table"));
  }
  // the answer with the metrics is counted, too, while it is on its way
  EXPECT_TRUE(eventually([&] { return metric("snapthrough_buffered_bytes") > 128 * 1024; }));
  EXPECT_LT(metric("snapthrough_buffered_bytes"), 8 * 256 * 1024);
  clients.clear();
  EXPECT_TRUE(eventually([&] { return metric("snapthrough_connections") <= 1; }));
  EXPECT_TRUE(eventually([&] { return metric("snapthrough_buffered_bytes") == 0; }));
}

TEST_F(StreamedBody, ClientsThatDoNotReadAreLetGo) {
  start_with(1s, 64 << 20);
  std::vector<std::unique_ptr<Socket>> clients;
  for (int i = 0; i < 8; ++i) {
    clients.push_back(stalled(sweep_ + "/table"));
  }
  ASSERT_TRUE(eventually([&] { return tables_begun() == 8; }));
  EXPECT_TRUE(eventually([&] { return metric("snapthrough_connections") <= 1; })) << "nobody read";
  EXPECT_TRUE(eventually([&] { return metric("snapthrough_buffered_bytes") == 0; }));
  for (const auto& client : clients) {
    EXPECT_FALSE(client->receive().whole);
  }
}

/// An attempt in which a busy machine keeps this client from reading for long proves nothing, and is
/// repeated.
TEST_F(StreamedBody, AClientThatReadsSlowlyIsServedForAsLongAsItReads) {
  constexpr std::chrono::milliseconds kTime = 1s;
  start_with(kTime, 64 << 20);
  const std::string expected = get(port(), sweep_ + "/table").body;
  std::string text;
  std::chrono::steady_clock::duration took{};
  const auto was_read_steadily = [&] {
    const auto begin = std::chrono::steady_clock::now();
    Socket socket(port());
    socket.send("GET " + sweep_ + "/table HTTP/1.0\r\n\r\n");
    std::chrono::milliseconds longest{};
    text = socket.read_slowly(64 * 1024, 30ms, longest);
    took = std::chrono::steady_clock::now() - begin;
    return longest < kTime / 2;
  };
  ASSERT_TRUE(eventually(was_read_steadily));
  EXPECT_GT(took, 3 * kTime);
  EXPECT_EQ(text.substr(text.find("\r\n\r\n") + 4), expected);
}

TEST_F(StreamedBody, ATableOfASweepThatIsTriedAgainMeanwhileIsSeenToBeIncomplete) {
  texts_->failing = true;
  start_with(1h, 64 << 20);
  const auto client = stalled(sweep_ + "/table");
  ASSERT_TRUE(eventually([&] { return metric("snapthrough_buffered_bytes") > 0; }));
  texts_->failing = false;
  ASSERT_EQ(post(port(), sweep_ + "/retry?status=failed", "").status, 200);
  const Reply reply = client->receive();
  EXPECT_EQ(reply.header("X-Complete"), "true");
  EXPECT_FALSE(reply.whole);
  EXPECT_TRUE(eventually([&] { return log_text_.text().find("tried again while") != std::string::npos; }));
}

TEST_F(StreamedBody, LargeAnswersAreRefusedWhileTooMuchIsBeingSentAndSmallOnesAreNot) {
  start_with(1h, 512 * 1024);
  std::vector<std::unique_ptr<Socket>> clients;
  for (int i = 0; i < 8; ++i) {
    clients.push_back(stalled(sweep_ + "/table"));
  }
  // all are of one address, which has half of what there is: two pieces
  Reply refused;
  ASSERT_TRUE(eventually([&] {
    refused = get(port(), sweep_ + "/table");
    return refused.status == 503;
  }));
  EXPECT_TRUE(eventually([&] { return metric("snapthrough_buffered_bytes") < 512 * 1024; }));
  EXPECT_EQ(refused.header("Retry-After"), "1");
  EXPECT_THAT(refused.body, HasSubstr("problem:overloaded"));
  EXPECT_EQ(get(port(), sweep_).status, 200);
  clients.clear();
  EXPECT_TRUE(eventually([&] { return get(port(), sweep_ + "/table").status == 200; }));
}

TEST_F(StreamedBody, ALargeResultIsSentInPiecesByteForByte) {
  start(SolveFunction([](const Model&, const Analysis&, const Hooks&) {
    Result result;
    result.summary.termination = std::string(1'000'000, 'y');
    return result;
  }));
  const Reply posted = post(port(), "/v1/jobs", column_request());
  ASSERT_EQ(posted.status, 200);
  EXPECT_EQ(posted.header("Transfer-Encoding"), "chunked");
  ASSERT_TRUE(posted.whole);
  EXPECT_EQ(json::parse(posted.body)["summary"]["termination"].get<std::string>().size(), 1'000'000U);
  const Reply read = get(port(), posted.header("Location") + "/result");
  EXPECT_EQ(read.body, posted.body);
  EXPECT_EQ(read.header("ETag"), posted.header("ETag"));
}

}  // namespace
}  // namespace snapthrough::server::test
