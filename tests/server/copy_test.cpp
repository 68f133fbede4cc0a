/// @file
/// A store that is copied to another driver and back keeps what it had.

#include "server/store/copy.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/server/support/samples.h"
#include "tests/server/support/store_driver.h"

namespace snapthrough::server::test {
namespace {

using std::chrono_literals::operator""s;

const Lease kLease{"worker", at_second(1'000'000)};

/// Jobs in every state, and sweeps that ended, failed, were dismissed or wait.
void fill(Store& store) {
  for (int number = 1; number <= 5; ++number) {
    NewJob job = new_job(id_number(number), number);
    job.owner = number % 2 == 0 ? "ann" : "";
    job.content_key = "content " + std::to_string(number);
    job.annotations.label = "label " + std::to_string(number);
    job.annotations.metadata = R"({"a": "b"})";
    job.annotations.callback = "https://hooks.example/a";
    if (number <= 3) {
      job.lease = kLease;
    }
    ASSERT_TRUE(store.submit(job).ok());
  }
  ASSERT_TRUE(store.finish({id_number(1), 1}, sample_result(), at_second(30)).ok());
  ASSERT_TRUE(store.add_key(id_number(1), {{"first", "abc"}, at_second(1)}).ok());
  ASSERT_TRUE(store.add_key(id_number(1), {{"second", "abc"}, at_second(25)}).ok());
  const StoredPath reached{sample_result().branches, {}};
  ASSERT_TRUE(
      store.fail({id_number(2), 1}, {"no_convergence", "why\0not", "{}"}, reached, at_second(31)).ok());
  ASSERT_TRUE(store.dismiss(id_number(4), at_second(32)).ok());
  for (int number = 11; number <= 14; ++number) {
    NewSweep sweep{id_number(number), "t", column_sweep(9000), 9000, at_second(number)};
    sweep.analysis_type = "path";
    ASSERT_TRUE(store.sweeps().submit(sweep).ok());
    ASSERT_TRUE(store.sweeps().add_key(sweep.id, {{"key " + sweep.id, "def"}, at_second(number)}).ok());
    const std::uint64_t most = number == 14 ? 0 : number == 13 ? 10 : 9000;
    if (most == 0) {
      continue;
    }
    const ItemClaim claim = **store.sweeps().claim(sweep.id, most, kLease, at_second(40));
    std::vector<PointRow> rows;
    for (std::uint64_t point = 0; point < most; ++point) {
      rows.push_back({point, {"[" + std::to_string(point) + ".25]", "", ""}, "key"});
    }
    if (number == 12) {
      rows[4].outcome = {"", "no_convergence", "step 1"};
    }
    ASSERT_TRUE(store.sweeps().put(claim, rows, at_second(50)).ok());
    if (number == 13) {
      ASSERT_TRUE(store.sweeps().dismiss(sweep.id, at_second(60))->changed);
    }
  }
}

/// A running sweep of curves with many gaps: every third item has rows, and of one item half the rows.
NewSweep sweep_with_gaps(Store& store) {
  constexpr std::uint64_t kCurve = 3;
  NewSweep sweep{id_number(15), "t", followed_sweep(kCurve), 9000 * kCurve, at_second(15)};
  sweep.item_points = kCurve;
  EXPECT_TRUE(store.sweeps().submit(sweep).ok());
  const ItemClaim claim = **store.sweeps().claim(sweep.id, 9000, kLease, at_second(40));
  std::vector<PointRow> rows;
  for (std::uint64_t point = 0; point < 9000 * kCurve; ++point) {
    if (point / kCurve % 3 == 0 && point != 9 * kCurve) {
      rows.push_back({point, {"[" + std::to_string(point) + ".25]", "", ""}});
    }
  }
  EXPECT_TRUE(store.sweeps().put(claim, rows, at_second(50)).ok());
  return sweep;
}

/// Claims of a sweep until none is left, as the items that they have.
std::vector<bool> items_left(Store& store, const NewSweep& sweep) {
  std::vector<bool> left(static_cast<std::size_t>(sweep.points / sweep.item_points));
  for (;;) {
    const auto claim = store.sweeps().claim(sweep.id, 100'000, kLease, at_second(90));
    if (!claim.ok() || !claim->has_value()) {
      return left;
    }
    for (std::uint64_t item = 0; item < (*claim)->items.count; ++item) {
      left.at((*claim)->items.first + item) = true;
    }
  }
}

template <class AnyStore>
std::string keys_of(AnyStore& store, const std::string& id) {
  std::string text;
  const std::vector<UsedKey> keys = *store.keys(id);
  for (const UsedKey& used : keys) {
    text += " " + used.key.key + "=" + used.key.fingerprint + "@" + rfc3339(used.first_used);
  }
  return text;
}

/// All that a copy keeps, as text.
std::string told(Store& store) {
  std::string text;
  const std::vector<std::string> owners = *store.owners();
  for (const std::string& owner : owners) {
    const JobPage jobs = *store.list({100, {}, {}, owner});
    for (const Job& job : jobs.jobs) {
      text += job.id + " " + std::string(to_string(job.state)) + " " + job.owner + " " + job.title + " " +
              std::to_string(job.attempt) + " " + std::to_string(job.crashes) + keys_of(store, job.id) + " " +
              job.content_key + " " + job.annotations.label + " " + rfc3339(job.created) + " " +
              (job.finished ? rfc3339(*job.finished) : "") + " " + store.request(job.id)->value_or("none") +
              result_of(store, job.id).value_or("") + " " +
              std::to_string(store.path(job.id)->branches.size()) + " " +
              std::to_string(store.path(job.id)->critical_points.size()) +
              (job.failure ? job.failure->code + job.failure->detail : "") + "\n";
    }
    const SweepPage sweeps = *store.sweeps().list({100, {}, {}, owner});
    for (const SweepRecord& sweep : sweeps.sweeps) {
      std::size_t rows = 0;
      EXPECT_TRUE(store.sweeps()
                      .each_row(sweep.id, {},
                                [&](std::uint64_t point, const api::PointOutcome& outcome) {
                                  rows += std::hash<std::string>()(std::to_string(point) + outcome.outputs +
                                                                   outcome.code + outcome.detail);
                                  return true;
                                })
                      .ok());
      text += sweep.id + " " + std::string(to_string(sweep.state)) + " " + std::to_string(sweep.successful) +
              " " + std::to_string(sweep.failed) + " " + rfc3339(sweep.created) +
              (sweep.finished ? rfc3339(*sweep.finished) : "") + " " + std::to_string(rows) +
              keys_of(store.sweeps(), sweep.id) + "\n";
    }
  }
  return text;
}

TEST(Copy, ToAnotherDriverAndBackKeepsJobsSweepsAndRows) {
  const std::vector<StoreDriver> drivers = store_drivers();
  const TempDir first_folder;
  const TempDir second_folder;
  const TempDir third_folder;
  const auto first = *drivers[0].open(first_folder);
  const auto second = *drivers[1].open(second_folder);
  const auto third = *drivers[0].open(third_folder);
  fill(*first);
  if (testing::Test::HasFatalFailure()) {
    return;
  }
  const auto silent = [](const CopyCounts&) {};
  CopyCounts there;
  const Status copied = copy_store(*first, *second, there, silent);
  ASSERT_TRUE(copied.ok()) << copied.message();
  EXPECT_EQ(there.jobs, 5);
  EXPECT_EQ(there.sweeps, 4);
  CopyCounts back;
  ASSERT_TRUE(copy_store(*second, *third, back, silent).ok());
  EXPECT_EQ((*second->get(id_number(3)))->state, JobState::accepted) << "it ran";
  std::string expected = told(*first);
  const std::size_t running = expected.find(" running ");
  expected.replace(running, 9, " accepted ");
  EXPECT_EQ(told(*second), expected);
  EXPECT_EQ(told(*third), expected);
  EXPECT_EQ(*second->deliveries().waiting(), 0) << "nobody is told again of what has ended";
  CopyCounts again;
  ASSERT_TRUE(copy_store(*first, *second, again, silent).ok());
  EXPECT_EQ(again.there, 9);
  EXPECT_EQ(again.jobs + again.sweeps, 0);
}

TEST(Copy, KeepsAttemptsAndCrashesOfJobs) {
  for (const std::size_t source : {0U, 1U}) {
    const TempDir first_folder;
    const TempDir second_folder;
    const auto first = *store_drivers()[source].open(first_folder);
    const auto second = *store_drivers()[1 - source].open(second_folder);
    for (int number = 1; number <= 4; ++number) {
      ASSERT_TRUE(first->submit(new_job(id_number(number), number)).ok());
    }
    ASSERT_TRUE(first->dismiss(id_number(4), at_second(9)).ok()) << "before any attempt";
    for (int attempt = 1; attempt <= 2; ++attempt) {  // two workers die with jobs 1 to 3
      for (int number = 1; number <= 3; ++number) {
        ASSERT_TRUE(
            (*first->claim({"dead", at_second(10 * attempt + 1)}, at_second(10 * attempt))).has_value());
      }
      ASSERT_EQ(first->rescue("alive", 3, at_second(10 * attempt + 2))->requeued.size(), 3U);
    }
    ASSERT_TRUE(first->claim(kLease, at_second(40)).ok());
    ASSERT_TRUE(first->finish({id_number(1), 3}, sample_result(), at_second(41)).ok());
    ASSERT_TRUE(first->claim(kLease, at_second(42)).ok());
    CopyCounts counts;
    const Status copied = copy_store(*first, *second, counts, [](const CopyCounts&) {});
    ASSERT_TRUE(copied.ok()) << copied.message();
    std::string expected = told(*first);
    expected.replace(expected.find(" running "), 9, " accepted ");
    EXPECT_EQ(told(*second), expected);
    const std::optional<Claim> third = *second->claim({"dead", at_second(51)}, at_second(50));
    ASSERT_TRUE(third.has_value());
    EXPECT_EQ(third->attempt, 4) << "job 2 had three claims";
    EXPECT_EQ(second->rescue("alive", 3, at_second(52))->failed, std::vector{id_number(2)})
        << "its third crash";
  }
}

TEST(Copy, ARepeatedSubmissionFindsItsJobInTheCopy) {
  const TempDir first_folder;
  const TempDir second_folder;
  const auto first = *store_drivers()[0].open(first_folder);
  const auto second = *store_drivers()[1].open(second_folder);
  NewJob job = new_job(id_number(1), 1);
  job.idempotency = IdempotencyKey{"once", "abc"};
  ASSERT_TRUE(first->submit(job).ok());
  ASSERT_TRUE(second->submit(job).ok());
  ASSERT_TRUE(second->forget_keys(std::chrono::seconds(0), at_second(2)).ok());
  CopyCounts counts;
  ASSERT_TRUE(copy_store(*first, *second, counts, [](const CopyCounts&) {}).ok());
  EXPECT_EQ(counts.there, 1) << "a copy that was cut short before the keys";
  job.id = id_number(2);
  const Submitted again = *second->submit(job);
  EXPECT_EQ(again.kind, Submitted::Kind::repeated);
  EXPECT_EQ(again.id, id_number(1));
  ASSERT_TRUE(second->forget_keys(std::chrono::seconds(10), at_second(12)).ok());
  EXPECT_TRUE(second->keys(id_number(1))->empty()) << "its age is that in the source";
}

TEST(Copy, AnUnfinishedSweepGoesOnWithItsRows) {
  for (const std::size_t source : {0U, 1U}) {
    const TempDir first_folder;
    const TempDir second_folder;
    const auto first = *store_drivers()[source].open(first_folder);
    const auto second = *store_drivers()[1 - source].open(second_folder);
    const NewSweep sweep = sweep_with_gaps(*first);
    CopyCounts counts;
    const Status copied = copy_store(*first, *second, counts, [](const CopyCounts&) {});
    ASSERT_TRUE(copied.ok()) << copied.message();
    EXPECT_EQ(told(*second), told(*first));
    const std::vector<bool> left = items_left(*second, sweep);
    EXPECT_EQ(std::count(left.begin(), left.end(), true), 6001) << "those with rows are not computed again";
    EXPECT_TRUE(left[9]) << "half a curve is computed wholly";
  }
}

TEST(Copy, AnUnfinishedSweepThatWasCutShortIsCopiedAgain) {
  const TempDir first_folder;
  const TempDir second_folder;
  const auto first = *store_drivers()[0].open(first_folder);
  const auto second = *store_drivers()[1].open(second_folder);
  NewSweep sweep = sweep_with_gaps(*first);
  ASSERT_TRUE(second->sweeps().submit(sweep).ok());
  const Lease cut_short{"copy", at_second(40)};
  ASSERT_TRUE(second->sweeps().claim(sweep.id, 9000, cut_short, at_second(40)).ok());
  CopyCounts counts;
  ASSERT_TRUE(copy_store(*first, *second, counts, [](const CopyCounts&) {}).ok());
  EXPECT_EQ(counts.sweeps, 1);
  EXPECT_EQ(told(*second), told(*first));
  CopyCounts again;
  ASSERT_TRUE(copy_store(*first, *second, again, [](const CopyCounts&) {}).ok());
  EXPECT_EQ(again.there, 1) << "a whole one stays";
}

TEST(Copy, OneThatWasCutShortIsMadeGood) {
  const TempDir first_folder;
  const TempDir second_folder;
  const auto first = *store_drivers()[0].open(first_folder);
  const auto second = *store_drivers()[1].open(second_folder);
  fill(*first);
  CopyCounts counts;
  int told_so_far = 0;
  EXPECT_THROW(static_cast<void>(copy_store(*first, *second, counts,
                                            [&](const CopyCounts&) {
                                              if (++told_so_far == 6) {
                                                throw std::runtime_error("killed");
                                              }
                                            })),
               std::runtime_error);
  // one that had begun and not ended
  NewJob half = new_job(id_number(1), 1);
  ASSERT_TRUE(*second->remove(half.id));
  half.lease = kLease;
  ASSERT_TRUE(second->submit(half).ok());
  ASSERT_TRUE(copy_store(*first, *second, counts, [](const CopyCounts&) {}).ok());
  std::string expected = told(*first);
  expected.replace(expected.find(" running "), 9, " accepted ");
  EXPECT_EQ(told(*second), expected);
}

}  // namespace
}  // namespace snapthrough::server::test
