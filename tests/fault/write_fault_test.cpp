/// @file
/// Every write of the database made to fail in turn, and a disk that is full at every size.

#include <gmock/gmock.h>
#include <sqlite3.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "server/store/sqlite/sqlite_store.h"
#include "solver/solve.h"
#include "tests/recorded.h"
#include "tests/server/support/running_service.h"
#include "tests/server/support/store_driver.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;

/// A layer over the system's files in which the n-th write, sync or truncation fails, and those after it too
/// while `broken_for` lasts. sqlite3_vfs and sqlite3_io_methods are copied, so all else goes straight
/// through.
struct FaultyFiles {
  std::atomic<std::int64_t> left = -1;  ///< writes until the fault; < 0: none comes
  std::atomic<std::int64_t> broken_for = 1;
  std::atomic<std::int64_t> writes = 0;
  int code = SQLITE_IOERR_WRITE;

  /// Whether this write fails.
  bool fails() {
    ++writes;
    if (left < 0) {
      return false;
    }
    if (left > 0) {
      --left;
      return false;
    }
    if (--broken_for <= 0) {
      left = -1;
    }
    return true;
  }
  void break_after(std::int64_t count, std::int64_t lasting, int with) {
    code = with;
    broken_for = lasting;
    left = count;
  }
};

FaultyFiles faults;
sqlite3_vfs* real_files = nullptr;
sqlite3_vfs faulty_files;
/// Files come with one of several tables of methods; each gets a copy with faults.
struct FaultyMethods {
  const sqlite3_io_methods* real = nullptr;
  sqlite3_io_methods copy{};
};
std::array<FaultyMethods, 8> tables;
const sqlite3_io_methods* real_methods = nullptr;  ///< of any file: reading and writing is the same in all

int faulty_write(sqlite3_file* file, const void* data, int size, sqlite3_int64 offset) {
  return faults.fails() ? faults.code : real_methods->xWrite(file, data, size, offset);
}
int faulty_sync(sqlite3_file* file, int flags) {
  return faults.fails() ? SQLITE_IOERR_FSYNC : real_methods->xSync(file, flags);
}
int faulty_truncate(sqlite3_file* file, sqlite3_int64 size) {
  return faults.fails() ? SQLITE_IOERR_TRUNCATE : real_methods->xTruncate(file, size);
}
int faulty_open(sqlite3_vfs* /*vfs*/, sqlite3_filename name, sqlite3_file* file, int flags, int* out) {
  const int code = real_files->xOpen(real_files, name, file, flags, out);
  if (code == SQLITE_OK && file->pMethods != nullptr) {
    for (FaultyMethods& table : tables) {
      if (table.real == nullptr) {
        table.real = file->pMethods;
        table.copy = *table.real;
        table.copy.xWrite = faulty_write;
        table.copy.xSync = faulty_sync;
        table.copy.xTruncate = faulty_truncate;
        real_methods = table.real;
      }
      if (table.real == file->pMethods) {
        file->pMethods = &table.copy;
        break;
      }
    }
  }
  return code;
}

class WriteFaults : public testing::Test {
 protected:
  void SetUp() override {
    if (real_files == nullptr) {
      real_files = sqlite3_vfs_find(nullptr);
      faulty_files = *real_files;
      faulty_files.zName = "faulty";
      faulty_files.xOpen = faulty_open;
    }
    sqlite3_vfs_register(&faulty_files, 1);
    faults.left = -1;
  }
  void TearDown() override {
    faults.left = -1;
    sqlite3_vfs_register(real_files, 1);
  }

  void open() {
    auto opened = sqlite::open_store(folder_.file("store.db"), at_second(0));
    ASSERT_TRUE(opened.ok()) << opened.status().message();
    store_ = std::move(opened).value();
  }
  static Lease lease() { return {"worker", at_second(1'000'000)}; }

  /// A life of jobs; what was acknowledged is remembered.
  void live(int round) {
    for (int i = 0; i < 3; ++i) {
      const std::string id = id_number(1000 * round + i);
      if (store_->submit(new_job(id)).ok()) {
        submitted_.insert(id);
      }
    }
    for (int i = 0; i < 2; ++i) {
      const auto claim = store_->claim(lease(), at_second(1));
      if (claim.ok() && claim->has_value() && store_->finish(**claim, sample_result(), at_second(2)).ok()) {
        finished_.insert((*claim)->id);
      }
    }
  }
  void check() {
    for (const std::string& id : submitted_) {
      const auto job = store_->get(id);
      ASSERT_TRUE(job.ok() && job->has_value()) << id << " was acknowledged";
      EXPECT_EQ(result_of(*store_, id).has_value(), (*job)->state == JobState::successful) << id;
    }
    for (const std::string& id : finished_) {
      EXPECT_EQ((*store_->get(id))->state, JobState::successful) << id;
    }
  }

  TempDir folder_;
  std::unique_ptr<Store> store_;
  std::set<std::string> submitted_;
  std::set<std::string> finished_;
};

TEST_F(WriteFaults, EachWriteThatFailsIsReportedAndLeavesTheStoreWhole) {
  open();
  const std::int64_t before = faults.writes;
  live(0);
  const std::int64_t writes = faults.writes - before;
  ASSERT_GT(writes, 10);
  std::int64_t reported = 0;
  int round = 1;
  for (const int code : {SQLITE_IOERR_WRITE, SQLITE_FULL}) {
    for (std::int64_t n = 0; n < writes + 5 && !HasFailure(); ++n, ++round) {
      const std::size_t count = submitted_.size() + finished_.size();
      faults.break_after(n, 1 + n % 3, code);
      live(round);
      reported += submitted_.size() + finished_.size() < count + 5 ? 1 : 0;
      faults.left = -1;
      ASSERT_TRUE(store_->list({}).ok()) << "reading goes on";
      ASSERT_TRUE(store_->probe(at_second(3)).ok()) << "it recovers by itself";
      check();
    }
    store_.reset();
    open();
    ASSERT_TRUE(store_->recover(1000, at_second(4)).ok());
    check();
  }
  EXPECT_GT(reported, writes) << "most faults hit something";
  record_figure("writes_made_to_fail", 2 * writes);
  record_figure("lives_told_of_it", reported);
}

Result quick(const Model&, const Analysis&, const Hooks&) {
  const JobResult sample = sample_result();
  Result result;
  result.summary = sample.summary;
  result.branches = sample.branches;
  result.critical_points = sample.critical_points;
  return result;
}

/// A service on a small disk of its own.
class FullDisk : public ServiceTest {
 protected:
  void SetUp() override {
    disk_ = folder_.file("disk");
    ::mkdir(disk_.c_str(), 0700);
    mounted_ = ::mount("tmpfs", disk_.c_str(), "tmpfs", 0, "size=24m") == 0;
  }
  void TearDown() override {
    service_.reset();
    if (mounted_) {
      ::umount2(disk_.c_str(), MNT_DETACH);
    }
  }
  void start_small() {
    ServiceConfig small = config();
    small.store_path = disk_ + "/store.db";
    small.ballast_bytes = 64 * 1024;
    small.least_free_bytes = 0;
    service_ = std::make_unique<Service>(small, Environment::system(), local_runners(quick), log_);
    const Status status = service_->start();
    ASSERT_TRUE(status.ok()) << status.message();
  }
  bool wait_ready(int status) {
    return eventually([&] { return get(port(), "/readyz").status == status; });
  }
  /// Fills the disk but for that much.
  void fill(std::size_t but) const {
    std::ofstream file(disk_ + "/filler", std::ios::binary | std::ios::app);
    const std::vector<char> page(4096);
    while (file.write(page.data(), 4096).flush()) {
    }
    file.close();
    std::error_code ignored;
    const auto size = std::filesystem::file_size(disk_ + "/filler", ignored);
    std::filesystem::resize_file(disk_ + "/filler", size > but ? size - but : 0, ignored);
  }

  std::string disk_;
  bool mounted_ = false;
};

TEST_F(FullDisk, NoFalseCreatedAtAnyStepAndItRecovers) {
  if (!mounted_) {
    GTEST_SKIP() << "mounting a tmpfs needs root";
  }
  start_small();
  const std::string first = post(port(), "/v1/jobs", column_request("first")).header("Location");
  ASSERT_FALSE(first.empty());
  int refused = 0;
  std::set<std::string> told;
  for (std::size_t room = 0; room <= 96 * 1024 && !HasFailure(); room += 4096) {
    fill(room);
    for (int i = 0; i < 12; ++i) {
      const Reply reply =
          post(port(), "/v1/jobs", column_request(std::to_string(room) + "-" + std::to_string(i)),
               {"Content-Type: application/json", "Prefer: respond-async"});
      ASSERT_TRUE(reply.status == 201 || reply.status == 503) << reply.status << reply.body;
      refused += reply.status == 503 ? 1 : 0;
      if (reply.status == 201) {
        told.insert(reply.header("Location"));
      }
    }
    EXPECT_EQ(get(port(), first + "/result").status, 200) << "reading goes on";
    EXPECT_EQ(get(port(), "/livez").status, 200);
    for (const std::string& job : told) {
      EXPECT_EQ(get(port(), job).status, 200) << job << " at " << room;
    }
    std::filesystem::remove(disk_ + "/filler");
    ASSERT_TRUE(wait_ready(200)) << "recovers at " << room;
  }
  EXPECT_GT(refused, 0);
  for (const std::string& job : told) {
    EXPECT_EQ(json::parse(get(port(), job, {"Prefer: wait=60"}).body)["status"], "successful") << job;
  }
  record_figure("jobs_acknowledged", told.size());
  record_figure("jobs_refused", refused);
}

/// Documents come faster than the disk is looked at, until they are refused; all of them can be removed, and
/// the room is there again.
TEST_F(FullDisk, IsReadyAgainAfterRemovalsHoweverOftenItWasFull) {
  if (!mounted_) {
    GTEST_SKIP() << "mounting a tmpfs needs root";
  }
  start_small();
  std::string large = column_request();
  large.append(95'000 - large.size(), ' ');
  const auto submitted = [&] {
    const Reply reply =
        post(port(), "/v1/jobs", large,
             {"Content-Type: application/json", "Prefer: respond-async", "Cache-Control: no-cache"});
    EXPECT_TRUE(reply.status == 201 || reply.status == 503) << reply.body;
    return reply.header("Location");
  };
  for (int round = 0; round < 4 && !HasFailure(); ++round) {
    std::vector<std::string> jobs;
    ASSERT_TRUE(eventually([&] {  // the disk is looked at once a second
      if (std::string job = submitted(); !job.empty()) {
        jobs.push_back(std::move(job));
      }
      return !jobs.empty();
    })) << "round "
        << round << ": the space did not come back";
    for (std::string job = submitted(); !job.empty() && jobs.size() < 1000; job = submitted()) {
      jobs.push_back(std::move(job));
    }
    EXPECT_LT(jobs.size(), 1000U) << "the disk has 24 MB";
    for (const std::string& job : jobs) {
      EXPECT_EQ(call(port(), "DELETE", job, "", {}).status, 204) << "round " << round;
    }
  }
  EXPECT_TRUE(wait_ready(200));
}

TEST_F(FullDisk, ReadyzSaysSoWhileItLasts) {
  if (!mounted_) {
    GTEST_SKIP() << "mounting a tmpfs needs root";
  }
  start_small();
  ASSERT_TRUE(wait_ready(200));
  fill(0);
  for (int i = 0; i < 200 && get(port(), "/readyz").status == 200; ++i) {
    post(port(), "/v1/jobs", column_request(std::to_string(i)),
         {"Content-Type: application/json", "Prefer: respond-async"});
  }
  EXPECT_TRUE(wait_ready(503));
  std::filesystem::remove(disk_ + "/filler");
  EXPECT_TRUE(wait_ready(200));
  EXPECT_EQ(post(port(), "/v1/jobs", column_request("again")).status, 200);
}

}  // namespace
}  // namespace snapthrough::server::test
