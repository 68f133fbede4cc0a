/// @file
/// What any driver must do with sweeps.

#include <gmock/gmock.h>

#include <functional>

#include "server/store/sqlite/sqlite_store.h"
#include "tests/server/support/samples.h"
#include "tests/server/support/store_driver.h"

namespace snapthrough::server::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class SweepStoreConformance : public StoreTest {
 protected:
  SweepStore& sweeps() { return store_->sweeps(); }

  std::string submit(int number, std::int64_t points, const std::string& owner = "") {
    NewSweep sweep{id_number(number), "a title", "{\"sweep\": 1}", points, at_second(number), owner};
    EXPECT_TRUE(sweeps().submit(sweep).ok());
    return sweep.id;
  }
  PointClaim claim(const std::string& id, const std::vector<std::uint64_t>& points) {
    const auto claim = sweeps().claim(id, points, at_second(50));
    EXPECT_TRUE(claim.ok()) << claim.status().message();
    return claim.ok() ? *claim : PointClaim{};
  }
  static PointRow good(std::uint64_t point, const std::string& key = "") {
    return {point, {"[" + std::to_string(point) + ".5]", "", ""}, key};
  }
  static PointRow bad(std::uint64_t point) { return {point, {"", "no_convergence", "step 1"}, "k"}; }
  SweepRecord record(const std::string& id) {
    const auto found = sweeps().get(id);
    EXPECT_TRUE(found.ok() && found->has_value());
    return found.ok() ? found->value_or(SweepRecord{}) : SweepRecord{};
  }
  /// "point outputs code" of each row.
  std::vector<std::string> rows(const std::string& id, const PointQuery& query = {}) {
    std::vector<std::string> all;
    EXPECT_TRUE(sweeps()
                    .each_row(id, query,
                              [&](std::uint64_t point, const api::PointOutcome& outcome) {
                                all.push_back(std::to_string(point) + " " + outcome.outputs + outcome.code);
                                return true;
                              })
                    .ok());
    return all;
  }
};

TEST_P(SweepStoreConformance, ASweepIsThereAsItWasHandedIn) {
  const std::string id = submit(1, 3, "ann");
  const SweepRecord sweep = record(id);
  EXPECT_EQ(sweep.state, JobState::accepted);
  EXPECT_EQ(sweep.owner, "ann");
  EXPECT_EQ(sweep.title, "a title");
  EXPECT_EQ(sweep.points, 3);
  EXPECT_EQ(sweep.created, at_second(1));
  EXPECT_FALSE(sweep.started || sweep.finished);
  EXPECT_EQ(**sweeps().document(id), "{\"sweep\": 1}");
  EXPECT_THAT(*sweeps().unfinished(), ElementsAre(id));
  EXPECT_FALSE(sweeps().get(id_number(9))->has_value());
}

TEST_P(SweepStoreConformance, RowsAreReadForAsLongAsTheyAreWanted) {
  const std::string id = submit(1, 4);
  ASSERT_TRUE(sweeps().put(claim(id, {0, 1, 2, 3}), {good(0), good(1), good(2), good(3)}, at_second(3)).ok());
  int read = 0;
  ASSERT_TRUE(
      sweeps().each_row(id, {}, [&](std::uint64_t, const api::PointOutcome&) { return ++read < 2; }).ok());
  EXPECT_EQ(read, 2);
}

TEST_P(SweepStoreConformance, RowsComeInAnyOrderAndTheLastEndsIt) {
  const std::string id = submit(1, 4);
  const PointClaim late = claim(id, {2, 3});
  const PointClaim early = claim(id, {0, 1});
  EXPECT_EQ(record(id).state, JobState::running);
  EXPECT_EQ(record(id).started, at_second(50));
  ASSERT_TRUE(sweeps().put(late, {good(3), good(2)}, at_second(60)).ok());
  EXPECT_EQ(record(id).done(), 2);
  const auto last = sweeps().put(early, {good(0), good(1)}, at_second(70));
  ASSERT_TRUE(last.ok());
  EXPECT_EQ(last->state, JobState::successful);
  EXPECT_EQ(record(id).finished, at_second(70));
  EXPECT_THAT(rows(id), ElementsAre("0 [0.5]", "1 [1.5]", "2 [2.5]", "3 [3.5]"));
  EXPECT_THAT(rows(id, {1, 2, {}}), ElementsAre("1 [1.5]", "2 [2.5]"));
  EXPECT_THAT(*sweeps().unfinished(), IsEmpty());
  EXPECT_EQ(sweeps().claim(id, {0}, at_second(80)).status().code(), StatusCode::conflict);
}

TEST_P(SweepStoreConformance, AClaimStoresItsRowsOnce) {
  const std::string id = submit(1, 4);
  const PointClaim held = claim(id, {0, 1});
  ASSERT_TRUE(sweeps().put(held, {good(0)}, at_second(60)).ok());
  EXPECT_EQ(sweeps().put(held, {good(1)}, at_second(61)).status().code(), StatusCode::conflict);
  EXPECT_THAT(rows(id), ElementsAre("0 [0.5]"));
  const PointClaim again = claim(id, {0, 1});
  ASSERT_TRUE(sweeps().put(again, {bad(0), good(1)}, at_second(62)).ok());
  EXPECT_THAT(rows(id), ElementsAre("0 [0.5]", "1 [1.5]")) << "a point that has a row keeps it";
  EXPECT_EQ(record(id).successful, 2);
  EXPECT_EQ(record(id).failed, 0);
}

TEST_P(SweepStoreConformance, FailedPointsMakeItFailedAndAreTriedAgain) {
  const std::string id = submit(1, 3);
  EXPECT_FALSE(sweeps().retry(id, {})->changed);
  ASSERT_TRUE(sweeps().put(claim(id, {0, 1, 2}), {good(0), bad(1), good(2)}, at_second(60)).ok());
  EXPECT_EQ(record(id).state, JobState::failed);
  EXPECT_THAT(rows(id, {0, 9, true}), ElementsAre("1 no_convergence"));
  EXPECT_THAT(rows(id, {0, 9, false}), ElementsAre("0 [0.5]", "2 [2.5]"));
  const auto change = sweeps().retry(id, {});
  EXPECT_TRUE(change->changed);
  EXPECT_EQ(change->before, JobState::failed);
  EXPECT_EQ(record(id).state, JobState::accepted);
  EXPECT_FALSE(record(id).finished);
  const auto open = sweeps().open(id);
  EXPECT_THAT((*open)->done, ElementsAre(true, false, true));
  ASSERT_TRUE(sweeps().put(claim(id, {1}), {good(1)}, at_second(70)).ok());
  EXPECT_EQ(record(id).state, JobState::successful);
  EXPECT_EQ(record(id).successful, 3);
}

TEST_P(SweepStoreConformance, ADismissedSweepKeepsItsRowsAndTakesNoMore) {
  const std::string id = submit(1, 3);
  ASSERT_TRUE(sweeps().put(claim(id, {0}), {good(0)}, at_second(60)).ok());
  const PointClaim held = claim(id, {1});
  EXPECT_TRUE(sweeps().dismiss(id, at_second(61))->changed);
  EXPECT_FALSE(sweeps().dismiss(id, at_second(62))->changed);
  EXPECT_EQ(sweeps().put(held, {good(1)}, at_second(63)).status().code(), StatusCode::conflict);
  EXPECT_THAT(rows(id), ElementsAre("0 [0.5]"));
  EXPECT_TRUE(sweeps().retry(id, {})->changed);
  EXPECT_EQ(sweeps().put(held, {good(1)}, at_second(64)).status().code(), StatusCode::conflict)
      << "a claim from before";
  EXPECT_FALSE(sweeps().dismiss(id_number(9), at_second(1))->before);
}

TEST_P(SweepStoreConformance, PointsAreFoundByContentUnlessTheyFailed) {
  const std::string id = submit(1, 3);
  ASSERT_TRUE(sweeps().put(claim(id, {0, 1, 2}), {good(0, "a"), good(1, "b"), bad(2)}, at_second(60)).ok());
  const auto found = sweeps().find_outputs({"b", "c", "k", "a", ""});
  ASSERT_TRUE(found.ok());
  EXPECT_THAT(*found, ElementsAre("[1.5]", std::nullopt, std::nullopt, "[0.5]", std::nullopt));
  const std::string second = submit(2, 1);
  PointRow row = good(0, "a");
  row.reused = true;
  ASSERT_TRUE(sweeps().put(claim(second, {0}), {row}, at_second(61)).ok());
  EXPECT_EQ(record(second).reused, 1);
}

TEST_P(SweepStoreConformance, PointsOfADeadProcessAreTriedAgainAndThenGivenUp) {
  const std::string id = submit(1, 5);
  ASSERT_TRUE(sweeps().put(claim(id, {0}), {good(0)}, at_second(60)).ok());
  claim(id, {1, 2});
  reopen();
  EXPECT_EQ(*sweeps().recover(2, at_second(100)), 2);
  EXPECT_EQ(*sweeps().recover(2, at_second(100)), 0) << "each death is counted once";
  const auto open = sweeps().open(id);
  EXPECT_THAT((*open)->done, ElementsAre(true, false, false, false, false));
  EXPECT_THAT((*open)->crashes, testing::UnorderedElementsAre(testing::Pair(1, 1), testing::Pair(2, 1)));
  claim(id, {2});
  reopen();
  EXPECT_EQ(*sweeps().recover(2, at_second(101)), 0);
  EXPECT_THAT(rows(id), ElementsAre("0 [0.5]", "2 crashed"));
  ASSERT_TRUE(sweeps().put(claim(id, {1, 3, 4}), {good(1), good(3), good(4)}, at_second(102)).ok());
  EXPECT_EQ(record(id).state, JobState::failed);
}

TEST_P(SweepStoreConformance, ListsAreNewestFirstOfOneOwner) {
  submit(1, 1, "ann");
  submit(2, 1, "bob");
  submit(3, 1, "ann");
  submit(4, 1, "ann");
  ASSERT_TRUE(sweeps().dismiss(id_number(3), at_second(9)).ok());
  const auto ids = [&](const ListQuery& query) {
    std::vector<std::string> all;
    const StatusOr<SweepPage> page = sweeps().list(query);
    for (const SweepRecord& sweep : page->sweeps) {
      all.push_back(sweep.id);
    }
    return all;
  };
  EXPECT_THAT(ids({20, {}, {}, "ann"}), ElementsAre(id_number(4), id_number(3), id_number(1)));
  EXPECT_THAT(ids({20, {}, JobState::dismissed, "ann"}), ElementsAre(id_number(3)));
  const auto first = sweeps().list({2, {}, {}, "ann"});
  ASSERT_TRUE(first->next);
  EXPECT_THAT(ids({2, first->next, {}, "ann"}), ElementsAre(id_number(1)));
}

TEST_P(SweepStoreConformance, RemovedSweepsAreGoneAndTheirSpaceIsGivenBackInPieces) {
  const std::string id = submit(1, 5);
  ASSERT_TRUE(
      sweeps()
          .put(claim(id, {0, 1, 2, 3, 4}), {good(0, "a"), good(1), good(2), good(3), good(4)}, at_second(60))
          .ok());
  const std::string other = submit(2, 1);
  EXPECT_TRUE(*sweeps().remove(id));
  EXPECT_FALSE(*sweeps().remove(id));
  EXPECT_FALSE(sweeps().get(id)->has_value());
  EXPECT_FALSE(sweeps().document(id)->has_value());
  EXPECT_THAT(rows(id), IsEmpty());
  EXPECT_TRUE(*sweeps().purge(2));
  EXPECT_TRUE(*sweeps().purge(2));
  EXPECT_TRUE(*sweeps().purge(2));
  EXPECT_FALSE(*sweeps().purge(2));
  EXPECT_THAT(*sweeps().find_outputs({"a"}), ElementsAre(std::nullopt));
  EXPECT_EQ(record(other).points, 1);
  ASSERT_TRUE(sweeps().dismiss(other, at_second(70)).ok());
  EXPECT_EQ(*sweeps().retire(at_second(70)), 0);
  EXPECT_EQ(*sweeps().retire(at_second(71)), 1);
}

TEST_P(SweepStoreConformance, AnIdempotencyKeyIsOneSweep) {
  const auto with_key = [&](int number, const std::string& fingerprint) {
    NewSweep sweep{id_number(number), "", "{}", 1, at_second(number), "ann"};
    sweep.idempotency = IdempotencyKey{"key", fingerprint};
    return *sweeps().submit(sweep);
  };
  EXPECT_EQ(with_key(1, "f").kind, Submitted::Kind::created);
  EXPECT_EQ(with_key(2, "f").kind, Submitted::Kind::repeated);
  EXPECT_EQ(with_key(2, "f").id, id_number(1));
  EXPECT_EQ(with_key(2, "g").kind, Submitted::Kind::key_conflict);
  ASSERT_TRUE(sweeps().forget_keys(at_second(2)).ok());
  EXPECT_EQ(with_key(3, "g").kind, Submitted::Kind::created);
}

INSTANTIATE_TEST_SUITE_P(Drivers, SweepStoreConformance,
                         testing::Values(StoreDriver{"Sqlite",
                                                     [](const TempDir& folder) {
                                                       return sqlite::open_store(folder.file("store.db"),
                                                                                 at_second(0));
                                                     }}),
                         [](const auto& driver) { return driver.param.name; });

}  // namespace
}  // namespace snapthrough::server::test
