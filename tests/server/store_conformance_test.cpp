/// @file
/// What every driver of the store must do (tests/server/support/store_driver.cpp lists them).

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <functional>
#include <mutex>
#include <random>
#include <set>
#include <thread>

#include "server/store/store.h"
#include "tests/server/support/samples.h"
#include "tests/server/support/store_driver.h"

namespace snapthrough::server::test {
namespace {

using std::chrono_literals::operator""s;
using std::string_literals::operator""s;
using testing::ElementsAre;
using testing::IsEmpty;

/// Longer than any test.
const Lease kLease{"worker", at_second(1'000'000)};

class StoreConformance : public StoreTest {
 protected:
  void submit(int number) { ASSERT_TRUE(store_->submit(new_job(id_number(number), number)).ok()); }
  /// Claims the next job, which must exist.
  Claim claim(int second = 100) {
    auto claim = store_->claim(kLease, at_second(second));
    EXPECT_TRUE(claim.ok() && claim->has_value()) << claim.status().message();
    return claim.ok() && claim->has_value() ? **claim : Claim{};
  }
  Job job(int number) {
    const auto job = store_->get(id_number(number));
    EXPECT_TRUE(job.ok() && job->has_value()) << job.status().message();
    return job.ok() && job->has_value() ? **job : Job{};
  }
  std::vector<std::string> ids(const ListQuery& query) {
    const auto page = store_->list(query);
    EXPECT_TRUE(page.ok()) << page.status().message();
    std::vector<std::string> found;
    for (const Job& row : page->jobs) {
      found.push_back(row.id);
    }
    return found;
  }
  Status finish(const Claim& held) { return store_->finish(held, sample_result(), at_second(200)); }
  Status fail(const Claim& held) {
    return store_->fail(held, {"no_convergence", "why", R"({"reached": 1})"}, {}, at_second(200));
  }
};

TEST_P(StoreConformance, ASubmittedJobIsAcceptedAndKeepsItsRequest) {
  submit(1);
  const Job stored = job(1);
  EXPECT_EQ(stored.state, JobState::accepted);
  EXPECT_EQ(stored.title, "a title");
  EXPECT_EQ(stored.analysis_type, "path");
  EXPECT_EQ(stored.created, at_second(1));
  EXPECT_EQ(stored.started, std::nullopt);
  EXPECT_EQ(stored.finished, std::nullopt);
  EXPECT_EQ(stored.attempt, 0);
  EXPECT_EQ(*store_->request(id_number(1)), R"({"model": 1})");
}

TEST_P(StoreConformance, TextsAreKeptByteForByte) {
  NewJob job = new_job(id_number(1));
  job.title = "a\0b'\"; DROP TABLE jobs; -- \xc3\xa4"s;
  job.document = "";
  ASSERT_TRUE(store_->submit(job).ok());
  EXPECT_EQ((*store_->get(id_number(1)))->title, job.title);
  EXPECT_EQ(**store_->request(id_number(1)), "");
}

TEST_P(StoreConformance, WhatIsNotThereIsEmptyNotAnError) {
  EXPECT_EQ(*store_->request("nothing"), std::nullopt);
  EXPECT_EQ(result_of(*store_, "nothing"), std::nullopt);
  EXPECT_FALSE(store_->get("nothing")->has_value());
  EXPECT_THAT(store_->path("nothing")->branches, IsEmpty());
  EXPECT_FALSE(store_->claim(kLease, at_second(1))->has_value());
}

TEST_P(StoreConformance, AnIdIsTakenOnce) {
  submit(1);
  EXPECT_FALSE(store_->submit(new_job(id_number(1))).ok());
  EXPECT_THAT(ids({}), ElementsAre(id_number(1)));
}

TEST_P(StoreConformance, ClaimsGoInOrderOfArrival) {
  submit(2);
  submit(1);
  const Claim first = claim(7);
  EXPECT_EQ(first.id, id_number(2));
  EXPECT_EQ(first.attempt, 1);
  EXPECT_EQ(first.document, R"({"model": 1})");
  EXPECT_EQ(job(2).state, JobState::running);
  EXPECT_EQ(job(2).started, at_second(7));
  EXPECT_EQ(claim().id, id_number(1));
  EXPECT_FALSE(store_->claim(kLease, at_second(9))->has_value());
}

/// Characters of several bytes stand across every border between pieces of a store.
TEST_P(StoreConformance, ALongResultIsReadFromAnywhereAndGoesWithItsJob) {
  JobResult result = sample_result();
  result.document = "a";
  while (result.document.size() < 3'500'000) {
    result.document += "\xE2\x82\xAC\xC3\xA9" + std::to_string(result.document.size());
  }
  NewJob original = new_job(id_number(1), 100);
  original.content_key = "content";
  ASSERT_TRUE(store_->submit(original).ok());
  ASSERT_TRUE(store_->finish(claim(), result, at_second(200)).ok());
  EXPECT_EQ(result_of(*store_, id_number(1)), result.document);
  for (const std::size_t offset : {0UL, 1'048'570UL, 1'048'576UL, 2'097'150UL, 3'499'990UL}) {
    const DocumentPiece piece = *store_->result_piece(id_number(1), offset, 20);
    EXPECT_FALSE(piece.bytes.empty()) << offset;
    EXPECT_EQ(piece.bytes, result.document.substr(offset, piece.bytes.size())) << offset;
    EXPECT_EQ(piece.size, result.document.size());
  }
  EXPECT_EQ(store_->result_piece(id_number(1), result.document.size(), 20)->bytes, "");
  reopen();
  NewJob copy = new_job(id_number(2), 300);
  copy.content_key = "content";
  copy.reuse = true;
  copy.annotations.label = "mine";
  EXPECT_EQ(store_->submit(copy)->kind, Submitted::Kind::copied);
  ASSERT_TRUE(store_->remove(id_number(1)).ok());
  EXPECT_EQ(result_of(*store_, id_number(1)), std::nullopt);
  EXPECT_EQ(result_of(*store_, id_number(2)), result.document);
}

TEST_P(StoreConformance, AFinishedJobHasItsResultPathAndCriticalPoints) {
  submit(1);
  ASSERT_TRUE(finish(claim()).ok());
  EXPECT_EQ(job(1).state, JobState::successful);
  EXPECT_EQ(job(1).finished, at_second(200));
  const JobResult expected = sample_result();
  EXPECT_EQ(result_of(*store_, id_number(1)), expected.document);
  const DocumentPiece piece = *store_->result_piece(id_number(1), 2, 9);
  EXPECT_EQ(piece.bytes, expected.document.substr(2, 9));
  EXPECT_EQ(piece.size, expected.document.size());
  EXPECT_EQ(store_->result_piece(id_number(1), 1'000'000, 9)->bytes, "");
  EXPECT_EQ(store_->result_piece("nothing", 0, 9)->size, 0U);
  const StoredPath path = *store_->path(id_number(1));
  ASSERT_EQ(path.branches.size(), 2U);
  const Branch& branch = path.branches[0];
  EXPECT_EQ(branch.parent, std::nullopt);
  EXPECT_EQ(branch.load_factor, expected.branches[0].load_factor);  // bit for bit
  EXPECT_EQ(branch.arc_length, expected.branches[0].arc_length);
  EXPECT_EQ(branch.negative_eigenvalues, expected.branches[0].negative_eigenvalues);
  EXPECT_EQ(branch.stiffness_ratio, expected.branches[0].stiffness_ratio);
  ASSERT_EQ(branch.monitors.size(), 2U);
  EXPECT_EQ(branch.monitors[0].id, "tip");
  EXPECT_EQ(branch.monitors[0].values, expected.branches[0].monitors[0].values);
  EXPECT_EQ(branch.monitors[1].id, "crown");
  ASSERT_EQ(branch.contact_fraction.size(), 1U);
  EXPECT_EQ(branch.contact_fraction[0].values, expected.branches[0].contact_fraction[0].values);
  EXPECT_EQ(stored_fields_of(path), stored_fields_of({expected.branches, expected.critical_points}));
  EXPECT_EQ(path.branches[1].parent, 0);
  EXPECT_THAT(path.branches[1].load_factor, IsEmpty());
  ASSERT_EQ(path.critical_points.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(path.critical_points[i].type, expected.critical_points[i].type);
    EXPECT_EQ(path.critical_points[i].load_factor, expected.critical_points[i].load_factor);
    EXPECT_EQ(path.critical_points[i].error_estimate, expected.critical_points[i].error_estimate);
    EXPECT_EQ(path.critical_points[i].branch, expected.critical_points[i].branch);
    EXPECT_EQ(path.critical_points[i].multiplicity, expected.critical_points[i].multiplicity);
    EXPECT_EQ(path.critical_points[i].negative_after, 1);
  }
}

TEST_P(StoreConformance, AResultWithoutCriticalPointIsStored) {
  submit(1);
  JobResult result = sample_result();
  result.summary.critical_load_factor.reset();
  result.summary.critical_type.reset();
  result.critical_points.clear();
  ASSERT_TRUE(store_->finish(claim(), result, at_second(3)).ok());
  EXPECT_EQ(job(1).state, JobState::successful);
}

TEST_P(StoreConformance, AFailedJobHasItsReasonAndWhatWasReached) {
  submit(1);
  const JobResult reached = sample_result();
  ASSERT_TRUE(store_
                  ->fail(claim(), {"step_underflow", "too small", "{}"},
                         {reached.branches, reached.critical_points}, at_second(5))
                  .ok());
  const Job stored = job(1);
  EXPECT_EQ(stored.state, JobState::failed);
  ASSERT_TRUE(stored.failure.has_value());
  EXPECT_EQ(stored.failure->code, "step_underflow");
  EXPECT_EQ(stored.failure->detail, "too small");
  EXPECT_EQ(stored.failure->reached, "{}");
  const Job listed = store_->list({})->jobs.front();
  ASSERT_TRUE(listed.failure.has_value());
  EXPECT_EQ(listed.failure->code, "step_underflow");
  EXPECT_EQ(listed.failure->detail, "too small");
  EXPECT_EQ(listed.failure->reached, "") << "as large as a result";
  EXPECT_EQ(store_->path(id_number(1))->branches.size(), 2U);
  EXPECT_EQ(result_of(*store_, id_number(1)), std::nullopt);
}

TEST_P(StoreConformance, AResultThatCannotBeStoredLeavesNothingBehind) {
  submit(1);
  const Claim held = claim();
  JobResult result = sample_result();
  result.branches[1].id = 0;  // twice the same branch
  EXPECT_FALSE(store_->finish(held, result, at_second(3)).ok());
  EXPECT_EQ(job(1).state, JobState::running);
  EXPECT_EQ(result_of(*store_, id_number(1)), std::nullopt);
  EXPECT_THAT(store_->path(id_number(1))->branches, IsEmpty());
  EXPECT_TRUE(finish(held).ok());
}

TEST_P(StoreConformance, ARequeuedJobKeepsItsPlaceAndIsNoCrash) {
  submit(1);
  submit(2);
  ASSERT_TRUE(store_->requeue(claim()).ok());
  EXPECT_EQ(job(1).state, JobState::accepted);
  EXPECT_EQ(job(1).started, std::nullopt);
  EXPECT_EQ(job(1).crashes, 0);
  const Claim again = claim();
  EXPECT_EQ(again.id, id_number(1));
  EXPECT_EQ(again.attempt, 2);
}

TEST_P(StoreConformance, ALateWorkerCannotTouchAJobThatWasGivenToAnother) {
  submit(1);
  const Claim late = claim();
  ASSERT_TRUE(store_->requeue(late).ok());
  const Claim current = claim();
  EXPECT_EQ(finish(late).code(), StatusCode::conflict);
  EXPECT_EQ(fail(late).code(), StatusCode::conflict);
  EXPECT_EQ(store_->requeue(late).code(), StatusCode::conflict);
  EXPECT_EQ(job(1).state, JobState::running);
  EXPECT_TRUE(finish(current).ok());
}

TEST_P(StoreConformance, FencedVerbsAreRefusedInEveryStateButRunning) {
  submit(1);
  const Claim not_yet{id_number(1), 0, ""};
  const auto refused = [&](const Claim& held) {
    const JobState before = job(1).state;
    EXPECT_EQ(finish(held).code(), StatusCode::conflict) << to_string(before);
    EXPECT_EQ(fail(held).code(), StatusCode::conflict) << to_string(before);
    EXPECT_EQ(store_->requeue(held).code(), StatusCode::conflict) << to_string(before);
    EXPECT_EQ(job(1).state, before);
  };
  refused(not_yet);
  const Claim held = claim();
  ASSERT_TRUE(finish(held).ok());
  refused(held);
  submit(2);
  const Claim other = claim();
  ASSERT_TRUE(fail(other).ok());
  EXPECT_EQ(finish(other).code(), StatusCode::conflict);
  EXPECT_EQ(job(2).state, JobState::failed);
  EXPECT_EQ(result_of(*store_, id_number(2)), std::nullopt);
}

TEST_P(StoreConformance, ListsNewestFirstInPages) {
  for (int i = 1; i <= 5; ++i) {
    submit(i);
  }
  ListQuery query;
  query.limit = 2;
  EXPECT_THAT(ids(query), ElementsAre(id_number(5), id_number(4)));
  query.before = store_->list(query)->next;
  ASSERT_TRUE(query.before.has_value());
  submit(6);  // a new job must not shift the pages
  EXPECT_THAT(ids(query), ElementsAre(id_number(3), id_number(2)));
  query.before = store_->list(query)->next;
  EXPECT_THAT(ids(query), ElementsAre(id_number(1)));
  EXPECT_EQ(store_->list(query)->next, std::nullopt);
}

TEST_P(StoreConformance, AFullLastPageHasNoNext) {
  submit(1);
  submit(2);
  ListQuery query;
  query.limit = 2;
  EXPECT_EQ(store_->list(query)->next, std::nullopt);
}

TEST_P(StoreConformance, ListsOneState) {
  submit(1);
  submit(2);
  submit(3);
  ASSERT_TRUE(finish(claim()).ok());
  const Claim running = claim();
  ListQuery query;
  query.state = JobState::successful;
  EXPECT_THAT(ids(query), ElementsAre(id_number(1)));
  query.state = JobState::running;
  EXPECT_THAT(ids(query), ElementsAre(id_number(2)));
  query.state = JobState::accepted;
  EXPECT_THAT(ids(query), ElementsAre(id_number(3)));
  query.state = JobState::failed;
  EXPECT_THAT(ids(query), IsEmpty());
}

TEST_P(StoreConformance, ListsByLabelAnalysisAndTime) {
  const auto add = [&](int number, const char* label, const char* analysis, int second) {
    NewJob job = new_job(id_number(number), second);
    job.analysis_type = analysis;
    job.annotations = {label, label[0] == '\0' ? "" : R"({"k":"v"})"};
    ASSERT_TRUE(store_->submit(job).ok());
  };
  add(1, "a", "path", 10);
  add(2, "b", "path", 20);
  add(3, "a", "static", 20);
  add(4, "", "static", 5);  // the clock was set back
  ASSERT_TRUE(store_->dismiss(id_number(3), at_second(30)).ok());
  EXPECT_EQ(job(1).annotations, (Annotations{"a", R"({"k":"v"})"}));
  EXPECT_EQ(job(4).annotations, Annotations{});
  EXPECT_THAT(ids({}), ElementsAre(id_number(3), id_number(2), id_number(1), id_number(4)));
  ListQuery query;
  query.label = "a";
  EXPECT_THAT(ids(query), ElementsAre(id_number(3), id_number(1)));
  query.analysis = "static";
  EXPECT_THAT(ids(query), ElementsAre(id_number(3)));
  query.state = JobState::accepted;
  EXPECT_THAT(ids(query), IsEmpty());
  query = {};
  query.created_after = at_second(5);
  query.created_before = at_second(20);
  EXPECT_THAT(ids(query), ElementsAre(id_number(1)));
  query = {};
  query.limit = 1;
  std::vector<std::string> all;
  for (int i = 0; i < 4; ++i) {
    all.push_back(ids(query).at(0));
    query.before = store_->list(query)->next;
    EXPECT_EQ(query.before.has_value(), i < 3);
  }
  EXPECT_THAT(all, ElementsAre(id_number(3), id_number(2), id_number(1), id_number(4)));
}

TEST_P(StoreConformance, AResultIsCopiedForAJobThatIsAnnotatedOtherwise) {
  NewJob first = new_job(id_number(1));
  first.content_key = "content";
  ASSERT_TRUE(store_->submit(first).ok());
  ASSERT_TRUE(finish(claim()).ok());
  NewJob second = new_job(id_number(2), 300);
  second.content_key = "content";
  second.reuse = true;
  second.annotations.label = "mine";
  EXPECT_EQ(store_->submit(second)->kind, Submitted::Kind::copied);
  EXPECT_EQ(job(2).state, JobState::successful);
  EXPECT_EQ(job(2).finished, at_second(300));
  EXPECT_EQ(result_of(*store_, id_number(2)), result_of(*store_, id_number(1)));
  EXPECT_EQ(stored_fields_of(*store_->path(id_number(2))), stored_fields_of(*store_->path(id_number(1))));
  second.id = id_number(3);
  const Submitted again = *store_->submit(second);
  EXPECT_EQ(again.kind, Submitted::Kind::reused);
  EXPECT_EQ(again.id, id_number(2));
  second.annotations = {};
  EXPECT_EQ(store_->submit(second)->id, id_number(1));
  ASSERT_TRUE(*store_->remove(id_number(1)));
  EXPECT_TRUE(result_of(*store_, id_number(2)).has_value());
}

TEST_P(StoreConformance, EverythingSurvivesReopening) {
  submit(1);
  submit(2);
  ASSERT_TRUE(finish(claim()).ok());
  reopen();
  EXPECT_EQ(job(1).state, JobState::successful);
  EXPECT_EQ(result_of(*store_, id_number(1)), sample_result().document);
  EXPECT_EQ(store_->path(id_number(1))->branches[0].load_factor, sample_result().branches[0].load_factor);
  EXPECT_EQ(claim().id, id_number(2));
}

TEST_P(StoreConformance, JobsOfADeadProcessAreRecoveredAndFenced) {
  submit(1);
  submit(2);
  const Lease lease{"worker", at_second(250)};
  const Claim lost = **store_->claim(lease, at_second(100));
  reopen();
  const Recovery recovery = recover(2, at_second(300));
  EXPECT_THAT(recovery.requeued, ElementsAre(id_number(1)));
  EXPECT_THAT(recovery.failed, IsEmpty());
  EXPECT_EQ(job(1).state, JobState::accepted);
  EXPECT_EQ(job(1).crashes, 1);
  EXPECT_EQ(finish(lost).code(), StatusCode::conflict);
  const Claim again = **store_->claim(lease, at_second(240));
  EXPECT_EQ(again.attempt, lost.attempt + 1);
  EXPECT_EQ(finish(lost).code(), StatusCode::conflict);
  reopen();
  EXPECT_THAT(recover(2, at_second(400)).failed, ElementsAre(id_number(1)));
  EXPECT_EQ(job(1).state, JobState::failed);
  EXPECT_EQ(job(1).failure->code, "crashed");
  EXPECT_EQ(job(1).finished, at_second(400));
  EXPECT_EQ(job(2).state, JobState::accepted);
}

TEST_P(StoreConformance, RecoveryOfAnOrderlyStoreDoesNothing) {
  submit(1);
  submit(2);
  ASSERT_TRUE(finish(claim()).ok());
  reopen();
  const Recovery recovery = recover(1, at_second(1));
  EXPECT_THAT(recovery.requeued, IsEmpty());
  EXPECT_THAT(recovery.failed, IsEmpty());
  EXPECT_EQ(job(1).state, JobState::successful);
}

TEST_P(StoreConformance, ASharedStoreServesManyProcessesAndAnotherOnlyOne) {
  const StatusOr<std::unique_ptr<Store>> second = GetParam().open(folder_);
  if (!GetParam().shared) {
    EXPECT_EQ(second.status().code(), StatusCode::unavailable);
    return;
  }
  ASSERT_TRUE(second.ok()) << second.status().message();
  submit(1);
  EXPECT_EQ((*(*second)->claim(kLease, at_second(1)))->id, id_number(1));
  EXPECT_THAT((*second)->recover(1, at_second(2))->failed, IsEmpty()) << "the other process lives";
  EXPECT_EQ(job(1).state, JobState::running);
}

TEST_P(StoreConformance, EachJobIsClaimedByOneThreadOnly) {
  constexpr int kJobs = 60;
  for (int i = 0; i < kJobs; ++i) {
    submit(i);
  }
  std::mutex mutex;
  std::multiset<std::string> claimed;
  const auto work = [&] {
    for (;;) {
      const auto held = store_->claim(kLease, at_second(1));
      if (!held.ok() || !held->has_value()) {
        return;
      }
      const bool finished = finish(**held).ok();
      const std::lock_guard guard(mutex);
      claimed.insert((*held)->id + (finished ? "" : " not finished"));
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back(work);
      threads.emplace_back([&] {
        for (int n = 0; n < 50; ++n) {
          EXPECT_TRUE(store_->list({}).ok());  // readers go on meanwhile
        }
      });
    }
  }
  ASSERT_EQ(claimed.size(), static_cast<std::size_t>(kJobs));
  for (int i = 0; i < kJobs; ++i) {
    EXPECT_EQ(claimed.count(id_number(i)), 1U);
    EXPECT_EQ(job(i).state, JobState::successful);
  }
}

TEST_P(StoreConformance, AcknowledgedJobsSurviveKill) {
  store_.reset();
  int pipe_ends[2];
  ASSERT_EQ(::pipe(pipe_ends), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    auto store = GetParam().open(folder_);
    bool good = store.ok();
    for (int i = 0; good && i < 1000000; ++i) {
      good = (*store)->submit(new_job(id_number(i), i)).ok();
      good = good && (i % 3 != 0 || (*store)->claim(kLease, at_second(i)).ok());
      good = good && ::write(pipe_ends[1], &i, sizeof i) == sizeof i;
    }
    ::_exit(1);
  }
  ::close(pipe_ends[1]);
  int acknowledged = -1;
  while (acknowledged < 100 && ::read(pipe_ends[0], &acknowledged, sizeof acknowledged) > 0) {
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  while (::read(pipe_ends[0], &acknowledged, sizeof acknowledged) > 0) {
  }
  ::close(pipe_ends[0]);
  ASSERT_GE(acknowledged, 100);
  reopen();
  recover(3, at_second(2'000'000));
  for (int i = 0; i <= acknowledged; ++i) {
    EXPECT_EQ(job(i).state, JobState::accepted) << i;
  }
}

TEST_P(StoreConformance, AJobMayBeginWithItsWorker) {
  NewJob job = new_job(id_number(1), 1);
  job.lease = kLease;
  ASSERT_TRUE(store_->submit(job).ok());
  EXPECT_EQ(this->job(1).state, JobState::running);
  EXPECT_EQ(this->job(1).attempt, 1);
  EXPECT_FALSE(store_->claim(kLease, at_second(1))->has_value());
  EXPECT_TRUE(finish({job.id, 1}).ok());
}

TEST_P(StoreConformance, AClaimPastItsLeaseFinishesNothing) {
  submit(1);
  const Claim held = **store_->claim({"slow", at_second(150)}, at_second(100));
  EXPECT_EQ(finish(held).code(), StatusCode::conflict);  // at second 200
  EXPECT_EQ(fail(held).code(), StatusCode::conflict);
  EXPECT_EQ(job(1).state, JobState::running);
  EXPECT_THAT(store_->rescue("other", 3, at_second(150))->requeued, IsEmpty());  // it may still be used now
  EXPECT_THAT(store_->rescue("other", 3, at_second(151))->requeued, ElementsAre(id_number(1)));
  EXPECT_EQ(job(1).crashes, 1);
  EXPECT_EQ(job(1).state, JobState::accepted);
}

TEST_P(StoreConformance, ALeaseThatIsRenewedHolds) {
  submit(1);
  submit(2);
  const Claim held = **store_->claim({"worker", at_second(150)}, at_second(100));
  const Claim late = **store_->claim({"worker", at_second(110)}, at_second(100));
  const auto lost = store_->renew({held, late}, at_second(250), at_second(120));
  EXPECT_THAT(*lost, ElementsAre(late.id));
  EXPECT_TRUE(finish(held).ok());
  EXPECT_EQ(finish(late).code(), StatusCode::conflict);
}

TEST_P(StoreConformance, ASlowLeaseOfALivingWorkerIsNoCrash) {
  submit(1);
  ASSERT_TRUE(store_->claim({"worker", at_second(110)}, at_second(100)).ok());
  EXPECT_THAT(store_->rescue("worker", 1, at_second(200))->requeued, ElementsAre(id_number(1)));
  EXPECT_EQ(job(1).crashes, 0);
  ASSERT_TRUE(store_->claim({"dead", at_second(210)}, at_second(201)).ok());
  EXPECT_THAT(store_->rescue("worker", 1, at_second(300))->failed, ElementsAre(id_number(1)));
  EXPECT_EQ(job(1).failure->code, "crashed");
}

TEST_P(StoreConformance, DismissesWhatHasNotEnded) {
  submit(1);
  submit(2);
  submit(3);
  ASSERT_TRUE(finish(claim()).ok());
  const Claim running = claim();
  EXPECT_EQ(store_->dismiss(id_number(1), at_second(5))->before, JobState::successful);
  EXPECT_EQ(job(1).state, JobState::successful);
  EXPECT_EQ(store_->dismiss(running.id, at_second(5))->before, JobState::running);
  EXPECT_EQ(finish(running).code(), StatusCode::conflict);
  EXPECT_EQ(job(2).finished, at_second(5));
  EXPECT_EQ(store_->dismiss(id_number(3), at_second(6))->before, JobState::accepted);
  EXPECT_EQ(store_->dismiss(id_number(3), at_second(7))->before, JobState::dismissed);
  EXPECT_EQ(job(3).finished, at_second(6));
  EXPECT_FALSE(store_->dismiss("nothing", at_second(7))->found);
}

TEST_P(StoreConformance, RemovesAJobWithAllThatBelongsToIt) {
  submit(1);
  submit(2);
  ASSERT_TRUE(finish(claim()).ok());
  const Claim running = claim();
  EXPECT_TRUE(*store_->remove(id_number(1)));
  EXPECT_TRUE(*store_->remove(running.id));
  EXPECT_FALSE(*store_->remove(id_number(1)));
  EXPECT_EQ(finish(running).code(), StatusCode::conflict);
  EXPECT_FALSE(store_->get(id_number(1))->has_value());
  EXPECT_EQ(result_of(*store_, id_number(1)), std::nullopt);
  EXPECT_THAT(store_->path(id_number(1))->branches, IsEmpty());
  EXPECT_THAT(ids({}), IsEmpty());
}

TEST_P(StoreConformance, AnIdempotencyKeyIsOneJobOfOneOwner) {
  NewJob first = new_job(id_number(1));
  first.idempotency = IdempotencyKey{"key", "body"};
  EXPECT_EQ(store_->submit(first)->kind, Submitted::Kind::created);
  NewJob again = new_job(id_number(2));
  again.idempotency = first.idempotency;
  EXPECT_EQ(store_->submit(again)->kind, Submitted::Kind::repeated);
  EXPECT_EQ(store_->submit(again)->id, first.id);
  again.idempotency->fingerprint = "another body";
  EXPECT_EQ(store_->submit(again)->kind, Submitted::Kind::key_conflict);
  EXPECT_THAT(ids({}), ElementsAre(first.id));
  again.owner = "somebody else";
  EXPECT_EQ(store_->submit(again)->kind, Submitted::Kind::created);
  ASSERT_TRUE(store_->forget_keys(0s, at_second(1)).ok());
  NewJob later = new_job(id_number(3));
  later.idempotency = first.idempotency;
  EXPECT_EQ(store_->submit(later)->kind, Submitted::Kind::created);
}

TEST_P(StoreConformance, FindsAResultByContentAndOwner) {
  for (int i = 1; i <= 2; ++i) {
    NewJob job = new_job(id_number(i));
    job.content_key = "content";
    ASSERT_TRUE(store_->submit(job).ok());
  }
  ASSERT_TRUE(fail(claim()).ok());
  EXPECT_EQ(*store_->find_result("content", ""), std::nullopt);  // what failed does not count
  ASSERT_TRUE(finish(claim()).ok());
  EXPECT_EQ(*store_->find_result("content", ""), id_number(2));
  EXPECT_EQ(*store_->find_result("content", "somebody else"), std::nullopt);
  EXPECT_EQ(*store_->find_result("", ""), std::nullopt);
  NewJob job = new_job(id_number(3));
  job.content_key = "content";
  job.reuse = true;
  job.idempotency = IdempotencyKey{"key", "body"};
  EXPECT_EQ(store_->submit(job)->kind, Submitted::Kind::reused);
  EXPECT_EQ(store_->submit(job)->kind, Submitted::Kind::repeated);
  EXPECT_EQ(store_->submit(job)->id, id_number(2));
}

TEST_P(StoreConformance, RetiresTheOldestThatEnded) {
  for (int i = 1; i <= 4; ++i) {
    submit(i);
  }
  for (int i = 1; i <= 3; ++i) {
    ASSERT_TRUE(store_->finish(claim(), sample_result(), at_second(10 * i)).ok());
  }
  EXPECT_EQ(*store_->retire(10s, 1, at_second(40)), 1);
  EXPECT_THAT(ids({}), ElementsAre(id_number(4), id_number(3), id_number(2)));
  EXPECT_EQ(*store_->retire(10s, 10, at_second(40)), 1);
  EXPECT_EQ(*store_->retire(10s, 10, at_second(40)), 0);
  EXPECT_THAT(ids({}), ElementsAre(id_number(4), id_number(3)));
}

TEST_P(StoreConformance, CountsWhatWaits) {
  submit(1);
  submit(2);
  submit(3);
  ASSERT_TRUE(finish(claim()).ok());
  claim();
  EXPECT_EQ(*store_->waiting(), 1);
}

TEST_P(StoreConformance, TellsSinceWhenTheOldestJobWaits) {
  EXPECT_EQ(*store_->oldest_waiting(at_second(50)), std::nullopt);
  for (int i = 1; i <= 3; ++i) {
    NewJob job = new_job(id_number(i));
    job.created = at_second(i);
    ASSERT_TRUE(store_->submit(job).ok());
  }
  EXPECT_EQ(*store_->oldest_waiting(at_second(50)), at_second(1));
  const Claim first = claim();
  EXPECT_EQ(first.created, at_second(1));
  EXPECT_EQ(*store_->oldest_waiting(at_second(50)), at_second(2));
  ASSERT_TRUE(store_->requeue(first).ok());
  EXPECT_EQ(*store_->oldest_waiting(at_second(50)), at_second(1)) << "back at its place";
}

TEST_P(StoreConformance, ListsOneOwnersJobs) {
  submit(1);
  NewJob job = new_job(id_number(2));
  job.owner = "she";
  ASSERT_TRUE(store_->submit(job).ok());
  ListQuery query;
  query.owner = "she";
  EXPECT_THAT(ids(query), ElementsAre(id_number(2)));
  EXPECT_EQ(this->job(2).owner, "she");
}

TEST_P(StoreConformance, AWriteThatIsRefusedLeavesThoseBesideItAlone) {
  submit(0);
  std::vector<std::jthread> threads;
  std::atomic<int> refused = 0;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&, i] {
      for (int n = 0; n < 25; ++n) {
        refused += store_->submit(new_job(id_number(0))).ok() ? 0 : 1;  // taken
        EXPECT_TRUE(store_->submit(new_job(id_number(1 + 25 * i + n))).ok());
      }
    });
  }
  threads.clear();
  EXPECT_EQ(refused, 200);
  EXPECT_EQ(*store_->waiting(), 201);
}

/// What a store must hold, kept in plain memory.
struct ModelJob {
  JobState state = JobState::accepted;
  int attempt = 0;
  int crashes = 0;
};

class StoreModel : public StoreConformance {
 protected:
  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }

  void submit_next() {
    submit(static_cast<int>(model_.size()));
    model_.emplace_back();
  }
  void claim_next() {
    const auto oldest = std::find_if(model_.begin(), model_.end(),
                                     [](const ModelJob& job) { return job.state == JobState::accepted; });
    const auto held = store_->claim(kLease, at_second(1));
    ASSERT_TRUE(held.ok());
    ASSERT_EQ(held->has_value(), oldest != model_.end());
    if (oldest != model_.end()) {
      oldest->state = JobState::running;
      ++oldest->attempt;
      EXPECT_EQ((*held)->id, id_number(static_cast<int>(oldest - model_.begin())));
      EXPECT_EQ((*held)->attempt, oldest->attempt);
      claims_.push_back(**held);
    }
  }
  /// Ends or gives back a job with a claim that may be stale.
  void use_a_claim(JobEvent event) {
    if (claims_.empty()) {
      return;
    }
    const Claim held = claims_[static_cast<std::size_t>(pick(static_cast<int>(claims_.size())))];
    ModelJob& job = model_[static_cast<std::size_t>(std::stoi(held.id.substr(24)))];
    const bool holds = job.state == JobState::running && job.attempt == held.attempt;
    const Status status = event == JobEvent::finish ? finish(held)
                          : event == JobEvent::fail ? fail(held)
                                                    : store_->requeue(held);
    EXPECT_EQ(status.code(), holds ? StatusCode::ok : StatusCode::conflict);
    if (holds) {
      job.state = next_state(JobState::running, event).value();
    }
  }
  void crash() {
    reopen();
    recover(3, at_second(2'000'000));
    for (ModelJob& job : model_) {
      if (job.state == JobState::running) {
        job.state = ++job.crashes >= 3 ? JobState::failed : JobState::accepted;
      }
    }
  }
  void compare() {
    for (std::size_t i = 0; i < model_.size(); ++i) {
      const Job stored = job(static_cast<int>(i));
      ASSERT_EQ(stored.state, model_[i].state) << i;
      ASSERT_EQ(stored.attempt, model_[i].attempt) << i;
      ASSERT_EQ(stored.crashes, model_[i].crashes) << i;
      ASSERT_EQ(result_of(*store_, stored.id).has_value(), stored.state == JobState::successful) << i;
      ASSERT_EQ(stored.failure.has_value(), stored.state == JobState::failed) << i;
    }
  }

  std::vector<ModelJob> model_;
  std::vector<Claim> claims_;
  std::mt19937 random_;
};

TEST_P(StoreModel, ARandomLifeAgreesWithTheModel) {
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  random_.seed(seed);
  for (int step = 0; step < 300 && !HasFailure(); ++step) {
    switch (pick(12)) {
      case 0:
        crash();
        break;
      case 1:
      case 2:
      case 3:
        submit_next();
        break;
      case 4:
      case 5:
      case 6:
      case 7:
        claim_next();
        break;
      case 8:
        use_a_claim(JobEvent::fail);
        break;
      case 9:
        use_a_claim(JobEvent::requeue);
        break;
      default:
        use_a_claim(JobEvent::finish);
    }
    compare();
  }
}

INSTANTIATE_TEST_SUITE_P(Drivers, StoreConformance, testing::ValuesIn(store_drivers()), driver_name);
INSTANTIATE_TEST_SUITE_P(Drivers, StoreModel, testing::ValuesIn(store_drivers()), driver_name);

}  // namespace
}  // namespace snapthrough::server::test
