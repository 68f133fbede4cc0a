/// @file
/// A backup never writes to what it reads, nor is read together with what others left beside its name.

#include <gmock/gmock.h>
#include <sys/file.h>

#include <filesystem>

#include "server/descriptor.h"
#include "server/store/sqlite/connection.h"
#include "server/store/sqlite/sqlite_store.h"
#include "tests/server/support/process.h"
#include "tests/server/support/samples.h"
#include "tests/server/support/temp_dir.h"

namespace snapthrough::server::test {
namespace {

namespace files = std::filesystem;
using sqlite::back_up;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

class Backup : public testing::Test {
 protected:
  void SetUp() override {
    files::create_directory(folder_.file("copies"));
    live_ = *open(store_);
    add_jobs(*live_, 1, 40);
  }

  static StatusOr<std::unique_ptr<Store>> open(const std::string& path) {
    return sqlite::open_store(path, at_second(0));
  }
  static void add_jobs(Store& store, int first, int last) {
    for (int number = first; number <= last; ++number) {
      ASSERT_TRUE(store.submit(new_job(id_number(number), number)).ok());
    }
  }
  static std::int64_t jobs_in(Store& store) { return *store.waiting(); }
  std::int64_t jobs_in_copy(const std::string& path) {
    const auto copy = open(path);
    EXPECT_TRUE(copy.ok()) << copy.status().message();
    return copy.ok() ? jobs_in(**copy) : -1;
  }
  std::vector<std::string> copies() const {
    std::vector<std::string> names;
    for (const auto& entry : files::directory_iterator(folder_.file("copies"))) {
      names.push_back(entry.path().filename());
    }
    return names;
  }
  void expect_refused(const std::string& target) {
    const Status status = back_up(store_, target);
    EXPECT_FALSE(status.ok()) << target;
    EXPECT_THAT(status.message(), HasSubstr("a backup needs a name of its own")) << target;
    add_jobs(*live_, static_cast<int>(jobs_in(*live_)) + 1, static_cast<int>(jobs_in(*live_)) + 1);
  }

  TempDir folder_;
  std::string store_ = folder_.file("jobs.db");
  std::unique_ptr<Store> live_;
};

TEST_F(Backup, OntoTheStoreItselfIsRefusedByAnyName) {
  files::create_symlink(store_, folder_.file("copies/link.db"));
  files::create_hard_link(store_, folder_.file("copies/hard.db"));
  files::create_hard_link(store_, folder_.file("copies/name.db.part"));
  const std::string relative = files::relative(store_);
  for (const std::string& target : {store_, folder_.file("./jobs.db"), folder_.file("copies/../jobs.db"),
                                    relative, folder_.file("copies/link.db"), folder_.file("copies/hard.db"),
                                    folder_.file("copies/name.db"), store_ + "-wal", store_ + "-shm"}) {
    expect_refused(target);
  }
  const std::int64_t all = jobs_in(*live_);
  live_.reset();
  EXPECT_EQ(jobs_in_copy(store_), all) << "the live store kept what came after the refusals";
}

TEST_F(Backup, DoesNotUseWhatLiesBesideItsName) {
  const std::string target = folder_.file("copies/copy.db");
  ASSERT_TRUE(back_up(store_, target).ok());
  {
    // the copy is used, and its process dies: -wal and -shm stay
    const auto used = *open(target);
    add_jobs(*used, 101, 160);
    for (const char* ending : {"-wal", "-shm"}) {
      files::copy_file(target + ending, folder_.file("left") + ending);
    }
  }
  for (const char* ending : {"-wal", "-shm"}) {
    files::rename(folder_.file("left") + ending, target + ending);
  }
  add_jobs(*live_, 41, 50);
  ASSERT_TRUE(back_up(store_, target).ok());
  EXPECT_THAT(copies(), UnorderedElementsAre("copy.db"));
  EXPECT_EQ(jobs_in_copy(target), 50);
}

TEST_F(Backup, GoesOnAfterOneThatWasKilled) {
  const std::string target = folder_.file("copies/copy.db");
  for (const char* ending : {"", "-journal", "-wal", "-shm"}) {
    write_file(target + ".part" + ending, "what is left of a copy");
  }
  ASSERT_TRUE(back_up(store_, target).ok());
  EXPECT_THAT(copies(), UnorderedElementsAre("copy.db"));
  EXPECT_EQ(jobs_in_copy(target), 40);
}

TEST_F(Backup, OntoAStoreInUseIsRefused) {
  const std::string target = folder_.file("copies/other.db");
  const auto other = *open(target);
  add_jobs(*other, 201, 203);
  const Status status = back_up(store_, target);
  EXPECT_EQ(status.code(), StatusCode::unavailable);
  EXPECT_THAT(status.message(), HasSubstr("in use by another process"));
  EXPECT_EQ(jobs_in(*other), 3);
}

TEST_F(Backup, OfTwoAtATimeToOneNameTheSecondIsRefused) {
  const std::string target = folder_.file("copies/copy.db");
  write_file(target + ".part", "");
  const Descriptor first(::open((target + ".part").c_str(), O_RDWR | O_CLOEXEC));
  ASSERT_EQ(::flock(first.get(), LOCK_EX), 0);
  EXPECT_EQ(back_up(store_, target).code(), StatusCode::unavailable);
  EXPECT_THAT(copies(), UnorderedElementsAre("copy.db.part"));
}

TEST_F(Backup, IsForItsOwnerOnly) {
  const std::string target = folder_.file("copies/copy.db");
  ASSERT_TRUE(back_up(store_, target).ok());
  for (const std::string& path : {store_, target}) {
    EXPECT_EQ(files::status(path).permissions(), files::perms::owner_read | files::perms::owner_write)
        << path;
  }
}

TEST_F(Backup, AStoreGivesTheSpaceOfRemovedJobsBack) {
  const std::string large(1 << 20, 'x');
  for (int number = 1; number <= 30; ++number) {
    NewJob job = new_job(id_number(300 + number), number);
    job.document = large;
    ASSERT_TRUE(live_->submit(job).ok());
  }
  for (int number = 1; number <= 30; ++number) {
    ASSERT_TRUE(*live_->remove(id_number(300 + number)));
  }
  const std::int64_t before = jobs_in(*live_);
  const std::uint64_t unused = *live_->give_back_space();
  EXPECT_LT(unused, 1U << 20);
  EXPECT_EQ(jobs_in(*live_), before);
  live_.reset();
  EXPECT_LT(files::file_size(store_), 4U << 20) << "30 MB were removed";
  EXPECT_EQ(jobs_in_copy(store_), before);
}

}  // namespace
}  // namespace snapthrough::server::test
