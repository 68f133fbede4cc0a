/// @file
/// Allocations that fail in the front: a request or its connection ends, and the service goes on.

#include <gmock/gmock.h>

#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>
#include <nlohmann/json.hpp>

#include "tests/server/support/costly.h"
#include "tests/server/support/running_service.h"

namespace {

std::atomic<std::size_t> smallest_failing = std::numeric_limits<std::size_t>::max();
std::atomic<int> failures = 0;
thread_local bool exempt = false;

}  // namespace

// Not inlined: the compiler would take free() for the wrong counterpart of new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (size >= smallest_failing.load(std::memory_order_relaxed) && !exempt) {
    ++failures;
    throw std::bad_alloc();
  }
  void* const memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }

namespace snapthrough::server::test {
namespace {

using nlohmann::json;

/// While it lives, allocations from a number of bytes on fail in all threads but its own.
class AllocationLimit {
 public:
  explicit AllocationLimit(std::size_t smallest) {
    exempt = true;
    failures = 0;
    smallest_failing = smallest;
  }
  ~AllocationLimit() {
    smallest_failing = std::numeric_limits<std::size_t>::max();
    exempt = false;
  }
  AllocationLimit(const AllocationLimit&) = delete;
  AllocationLimit& operator=(const AllocationLimit&) = delete;
  AllocationLimit(AllocationLimit&&) = delete;
  AllocationLimit& operator=(AllocationLimit&&) = delete;
};

class FrontMemory : public ServiceTest {
 protected:
  void SetUp() override {
    ServiceConfig narrow = config();
    narrow.listener.threads = 1;  // one turn: a failure that kept it would stop the service
    narrow.listener.limits.body_bytes = 1'000'000;
    service_ = std::make_unique<Service>(narrow, Environment::system(), local_runners(quick), log_);
    ASSERT_TRUE(service_->start().ok());
  }
  static Result quick(const Model&, const Analysis&, const Hooks&) { return {}; }

  /// Sends it several times while allocations fail; each answer is a 503 or the end of the connection.
  void expect_refused(const std::string& bytes, std::size_t smallest) {
    const AllocationLimit limit(smallest);
    for (int i = 0; i < 4; ++i) {
      Socket socket(port());
      socket.send(bytes);
      const Reply reply = socket.receive();
      EXPECT_TRUE(reply.status == 503 || reply.status == 0) << reply.status;
      if (reply.status == 503) {
        EXPECT_EQ(json::parse(reply.body)["type"], "urn:snapthrough:problem:overloaded") << reply.body;
        EXPECT_EQ(reply.header("Retry-After"), "5");
      }
    }
    EXPECT_GE(failures, 4);
  }
  void expect_alive() const {
    EXPECT_EQ(get(port(), "/livez").status, 200);
    EXPECT_EQ(get(port(), "/v1/openapi.json").status, 200);
    EXPECT_EQ(post(port(), "/v1/jobs", column_request()).status, 200);
    EXPECT_EQ(get(port(), "/readyz").status, 200);
  }
};

TEST_F(FrontMemory, AHandlerWithoutMemoryIs503) {
  const std::size_t size = get(port(), "/v1/openapi.json").body.size();
  ASSERT_GT(size, 100'000U);
  expect_refused("GET /v1/openapi.json HTTP/1.1\r\nHost: localhost\r\n\r\n", size / 2);
  expect_alive();
}

TEST_F(FrontMemory, AResponseThatCannotBeWrittenIs503) {
  const std::size_t size = get(port(), "/v1/openapi.json").body.size();
  expect_refused("GET /v1/openapi.json HTTP/1.1\r\nHost: localhost\r\n\r\n", size + 100);
  expect_alive();
}

TEST_F(FrontMemory, ABodyThatCannotBeHeldEndsItsConnection) {
  expect_refused(posted("/v1/check", std::string(400'000, ' '), {"Content-Type: application/json"}), 100'000);
  expect_alive();
}

}  // namespace
}  // namespace snapthrough::server::test
