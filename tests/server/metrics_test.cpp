/// @file
/// What the service measures of itself, and the text format of Prometheus.

#include <gmock/gmock.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <thread>

#include "server/metrics/metrics.h"
#include "tests/server/support/running_service.h"

namespace snapthrough::server::test {
namespace {

using testing::HasSubstr;
using testing::Not;

const Headers kAsync{"Content-Type: application/json", "Prefer: respond-async"};

/// @brief Checks a text against the format: every sample belongs to the metric whose HELP and TYPE lines are
/// before it, no sample or metric is there twice, buckets add up, names have the endings of their types.
class ExpositionCheck {
 public:
  explicit ExpositionCheck(const std::string& text) {
    EXPECT_TRUE(text.ends_with('\n'));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      SCOPED_TRACE(line);
      line.starts_with("#") ? comment(line) : sample(line);
    }
  }
  /// The value of a sample, by its name with labels.
  [[nodiscard]] double value(const std::string& name) const {
    const auto found = samples_.find(name);
    return found == samples_.end() ? -1.0 : found->second;
  }

 private:
  void comment(const std::string& line) {
    static const std::regex form("# (HELP|TYPE) ([a-z_]+) (.+)");
    std::smatch parts;
    ASSERT_TRUE(std::regex_match(line, parts, form));
    EXPECT_TRUE(comments_.insert(parts[1].str() + parts[2].str()).second) << "told twice";
    if (parts[1] == "TYPE") {
      name_ = parts[2];
      type_ = parts[3];
      EXPECT_THAT((std::set<std::string>{"gauge", "counter", "histogram"}), testing::Contains(type_));
      EXPECT_EQ(type_ == "counter", name_.ends_with("_total"));
      EXPECT_TRUE(comments_.contains("HELP" + name_));
    }
  }
  void sample(const std::string& line) {
    static const std::string one = R"([a-z]+="(?:[^"\\]|\\["\\n])*")";
    static const std::regex form("([a-z_]+)(\\{(" + one + "(?:," + one + ")*)\\})? ([-+0-9.e]+)");
    std::smatch parts;
    ASSERT_TRUE(std::regex_match(line, parts, form));
    const std::string name = parts[1];
    const double value = std::stod(parts[4]);
    EXPECT_TRUE(samples_.emplace(name + parts[2].str(), value).second) << "told twice";
    if (type_ != "histogram") {
      EXPECT_EQ(name, name_);
    } else if (name == name_ + "_bucket") {
      EXPECT_GE(value, below_) << "buckets add up";
      below_ = value;
      last_bucket_ = parts[3];
    } else if (name == name_ + "_count") {
      EXPECT_THAT(last_bucket_, HasSubstr("le=\"+Inf\""));
      EXPECT_EQ(value, below_);
      below_ = 0.0;
    } else {
      EXPECT_EQ(name, name_ + "_sum");
    }
  }
  std::set<std::string> comments_;
  std::map<std::string, double> samples_;
  std::string name_;
  std::string type_;
  std::string last_bucket_;
  double below_ = 0.0;
};

TEST(Metrics, LabelsAreEscaped) {
  EXPECT_EQ(label("code", "a\"b\\c\nd"), R"(code="a\"b\\c\nd")");
  Counter counter("x_total", "Help.");
  counter.add(label("code", "a\"b\\c\nd"));
  std::string text;
  counter.write(text);
  EXPECT_EQ(ExpositionCheck(text).value(R"(x_total{code="a\"b\\c\nd"})"), 1);
}

TEST(Metrics, AHistogramAddsUpItsBuckets) {
  Histogram histogram("x_seconds", "Help.");
  for (const double seconds : {0.00005, 0.0001, 0.3, 0.5, 7000.0}) {
    histogram.observe(seconds, label("route", "/"));
  }
  std::string text;
  histogram.write(text);
  const ExpositionCheck check(text);
  EXPECT_EQ(check.value(R"(x_seconds_bucket{route="/",le="1e-04"})"), 2) << "a bound belongs to its bucket\n"
                                                                         << text;
  EXPECT_EQ(check.value(R"(x_seconds_bucket{route="/",le="0.5"})"), 4);
  EXPECT_EQ(check.value(R"(x_seconds_bucket{route="/",le="3600"})"), 4);
  EXPECT_EQ(check.value(R"(x_seconds_count{route="/"})"), 5);
  EXPECT_NEAR(check.value(R"(x_seconds_sum{route="/"})"), 7000.80015, 1e-9);
}

TEST_F(ServiceTest, MetricsTellOutcomesDurationsAndTheOldestWaitingJob) {
  workers_ = 1;
  const auto solver = std::make_shared<GatedSolver>();
  start(gated(solver));
  EXPECT_EQ(ExpositionCheck(get(port(), "/metrics").body).value("snapthrough_oldest_waiting_job_seconds"), 0);
  const std::string running = submit("running");
  solver->wait_started(1);
  const auto before = std::chrono::steady_clock::now();
  const std::string waiting = submit("waiting");
  const std::string dismissed = submit("dismissed");
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(call(port(), "POST", dismissed + "/dismiss", "", {}).status, 200);
  const double age =
      ExpositionCheck(get(port(), "/metrics").body).value("snapthrough_oldest_waiting_job_seconds");
  EXPECT_GT(age, 0.2);
  const std::chrono::duration<double> longest = std::chrono::steady_clock::now() - before;
  EXPECT_LT(age, longest.count() + 0.1) << "since it was handed in, in seconds";
  solver->open();
  EXPECT_EQ(get(port(), running, {"Prefer: wait=60"}).status, 200);
  EXPECT_EQ(get(port(), waiting, {"Prefer: wait=60"}).status, 200);
  post(port(), "/v1/sweeps", column_sweep(3));
  const ExpositionCheck check(get(port(), "/metrics").body);
  EXPECT_EQ(check.value(R"(snapthrough_jobs_ended_total{code="successful"})"), 2);
  EXPECT_EQ(check.value(R"(snapthrough_jobs_ended_total{code="dismissed"})"), 1);
  EXPECT_EQ(check.value("snapthrough_job_running_seconds_count"), 2);
  EXPECT_GT(check.value("snapthrough_job_running_seconds_sum"), 0.2);
  EXPECT_EQ(check.value("snapthrough_job_waiting_seconds_count"), 2);
  EXPECT_GT(check.value("snapthrough_job_waiting_seconds_sum"), 0.2);
  EXPECT_GT(check.value("snapthrough_store_commit_seconds_count"), 3);
  EXPECT_GT(check.value("snapthrough_store_read_seconds_count"), 3);
  EXPECT_EQ(check.value(R"(snapthrough_request_seconds_count{route="/v1/jobs"})"), 3);
}

TEST_F(ServiceTest, MetricsTellWhyJobsAndPointsFailed) {
  start([](const Model&, const Analysis&, const Hooks&) {
    Result result;
    result.failure = Failure{"no_convergence", "no equilibrium at load factor 3"};
    return result;
  });
  EXPECT_EQ(post(port(), "/v1/jobs", column_request()).status, 422);
  const std::string sweep = post(port(), "/v1/sweeps", column_sweep(3)).header("Location");
  EXPECT_EQ(get(port(), sweep, {"Prefer: wait=60"}).status, 200);
  // points are counted after the store shows them, hence perhaps after the answer that the sweep has ended
  const char* const points = R"(snapthrough_sweep_points_ended_total{code="no_convergence"})";
  const auto counted = [&] { return ExpositionCheck(get(port(), "/metrics").body).value(points); };
  EXPECT_TRUE(eventually([&] { return counted() >= 3; }));
  EXPECT_EQ(counted(), 3);
  EXPECT_EQ(ExpositionCheck(get(port(), "/metrics").body)
                .value(R"(snapthrough_jobs_ended_total{code="no_convergence"})"),
            1);
}

/// Each combination of labels is kept for ever.
TEST_F(ServiceTest, MethodsThatClientsInventAreOneInTheMetrics) {
  start([](const Model&, const Analysis&, const Hooks&) { return Result(); });
  for (const char* method : {"BREW", "B\"REW", "XYZZY"}) {
    Socket socket(port());
    socket.send(std::string(method) + " /livez HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_GE(socket.receive().status, 400);
  }
  const std::string text = get(port(), "/metrics").body;
  EXPECT_EQ(
      ExpositionCheck(text).value(R"(snapthrough_requests_total{method="other",route="none",status="501"})"),
      3);
  EXPECT_THAT(text, Not(HasSubstr("XYZZY")));
}

}  // namespace
}  // namespace snapthrough::server::test
