/// @file
/// What any driver must do with sweeps.

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>

#include "tests/server/support/samples.h"
#include "tests/server/support/store_driver.h"

namespace snapthrough::server::test {
namespace {

using std::chrono_literals::operator""s;
using testing::ElementsAre;
using testing::IsEmpty;

/// Longer than any test.
const Lease kLease{"worker", at_second(1'000'000)};

class SweepStoreConformance : public StoreTest {
 protected:
  SweepStore& sweeps() { return store_->sweeps(); }

  std::string submit(int number, std::int64_t points, const std::string& owner = "") {
    NewSweep sweep{id_number(number), "a title", "{\"sweep\": 1}", points, at_second(number), owner};
    EXPECT_TRUE(sweeps().submit(sweep).ok());
    return sweep.id;
  }
  /// Claims items, of which there must be some.
  ItemClaim claim(const std::string& id, std::uint64_t most, const Lease& lease = kLease) {
    const auto claim = sweeps().claim(id, most, lease, at_second(50));
    EXPECT_TRUE(claim.ok() && claim->has_value()) << claim.status().message();
    return claim.ok() ? claim->value_or(ItemClaim{}) : ItemClaim{};
  }
  bool none_left(const std::string& id) {
    const auto claim = sweeps().claim(id, 1, kLease, at_second(50));
    return claim.ok() && !claim->has_value();
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
  EXPECT_THAT(*sweeps().with_items(), ElementsAre(id));
  EXPECT_EQ(*sweeps().unfinished(), 1);
  EXPECT_FALSE(sweeps().get(id_number(9))->has_value());
}

TEST_P(SweepStoreConformance, RowsAreReadForAsLongAsTheyAreWanted) {
  const std::string id = submit(1, 4);
  ASSERT_TRUE(sweeps().put(claim(id, 4), {good(0), good(1), good(2), good(3)}, at_second(3)).ok());
  int read = 0;
  ASSERT_TRUE(
      sweeps().each_row(id, {}, [&](std::uint64_t, const api::PointOutcome&) { return ++read < 2; }).ok());
  EXPECT_EQ(read, 2);
}

TEST_P(SweepStoreConformance, RowsComeInAnyOrderAndTheLastEndsIt) {
  const std::string id = submit(1, 4);
  const ItemClaim early = claim(id, 2);
  const ItemClaim late = claim(id, 9);
  EXPECT_EQ(early.items, (ItemRun{0, 2}));
  EXPECT_EQ(late.items, (ItemRun{2, 2}));
  EXPECT_TRUE(none_left(id));
  EXPECT_EQ(record(id).state, JobState::running);
  EXPECT_EQ(record(id).started, at_second(50));
  EXPECT_EQ(sweeps().put(late, {good(3), good(2)}, at_second(60))->done(), 2);
  const auto ended = sweeps().put(early, {good(0), good(1)}, at_second(70));
  EXPECT_EQ(ended->state, JobState::successful);
  EXPECT_EQ(ended->finished, at_second(70));
  EXPECT_EQ(record(id).successful, 4);
  EXPECT_THAT(rows(id), ElementsAre("0 [0.5]", "1 [1.5]", "2 [2.5]", "3 [3.5]"));
  EXPECT_THAT(rows(id, {1, 2, {}}), ElementsAre("1 [1.5]", "2 [2.5]"));
  EXPECT_EQ(*sweeps().unfinished(), 0);
  EXPECT_EQ(sweeps().claim(id, 1, kLease, at_second(80)).status().code(), StatusCode::conflict);
}

TEST_P(SweepStoreConformance, AClaimStoresItsRowsOnceAndItsOtherItemsAreGivenOutAgain) {
  const std::string id = submit(1, 5);
  const ItemClaim held = claim(id, 4);
  ASSERT_TRUE(sweeps().put(held, {good(1), bad(3)}, at_second(60)).ok());
  EXPECT_EQ(sweeps().put(held, {good(0)}, at_second(61)).status().code(), StatusCode::conflict);
  EXPECT_THAT(rows(id), ElementsAre("1 [1.5]", "3 no_convergence"));
  EXPECT_EQ(record(id).successful, 1);
  EXPECT_EQ(record(id).failed, 1);
  std::vector<ItemRun> runs{claim(id, 4).items, claim(id, 4).items, claim(id, 4).items};
  std::sort(runs.begin(), runs.end(), [](const ItemRun& a, const ItemRun& b) { return a.first < b.first; });
  EXPECT_THAT(runs, ElementsAre(ItemRun{0, 1}, ItemRun{2, 1}, ItemRun{4, 1}));
  EXPECT_TRUE(none_left(id));
}

TEST_P(SweepStoreConformance, ACurveIsComputedAndTriedAgainWholly) {
  NewSweep sweep{id_number(1), "", "{}", 6, at_second(1)};
  sweep.item_points = 3;
  ASSERT_TRUE(sweeps().submit(sweep).ok());
  EXPECT_EQ(claim(sweep.id, 1).items, (ItemRun{0, 1}));
  const ItemClaim second = claim(sweep.id, 5);
  EXPECT_EQ(second.items, (ItemRun{1, 1}));
  ASSERT_TRUE(sweeps().put(second, {good(3), bad(4), good(5)}, at_second(60)).ok());
  ASSERT_TRUE(sweeps().dismiss(sweep.id, at_second(61))->changed);
  ASSERT_TRUE(sweeps().retry(sweep.id, {}, at_second(200))->changed);
  EXPECT_THAT(rows(sweep.id), ElementsAre("3 [3.5]", "5 [5.5]"));
  ASSERT_TRUE(sweeps().put(claim(sweep.id, 1), {good(0), good(1), good(2)}, at_second(62)).ok());
  const auto ended = sweeps().put(claim(sweep.id, 1), {bad(3), good(4), bad(5)}, at_second(63));
  EXPECT_EQ(ended->state, JobState::successful) << "a point that has a row keeps it";
  EXPECT_EQ(record(sweep.id).successful, 6);
  EXPECT_THAT(rows(sweep.id, {2, 3, {}}), ElementsAre("2 [2.5]", "3 [3.5]", "4 [4.5]"));
}

TEST_P(SweepStoreConformance, ALeaseOfItemsHoldsAsLongAsItIsRenewed) {
  const std::string id = submit(1, 3);
  const ItemClaim renewed = claim(id, 1, {"worker", at_second(100)});
  const ItemClaim late = claim(id, 1, {"worker", at_second(100)});
  EXPECT_THAT(*sweeps().renew({renewed}, at_second(200), at_second(90)), IsEmpty());
  EXPECT_THAT(*sweeps().renew({renewed, late}, at_second(200), at_second(110)), ElementsAre(late.number));
  EXPECT_EQ(sweeps().put(late, {good(1)}, at_second(111)).status().code(), StatusCode::conflict);
  EXPECT_EQ(*sweeps().rescue("worker", 1, at_second(112)), 1) << "its worker lives: no crash";
  EXPECT_EQ(claim(id, 1).items.first + claim(id, 1).items.first, 3U) << "it is given out again";
  EXPECT_TRUE(sweeps().put(renewed, {good(0)}, at_second(113)).ok());
}

TEST_P(SweepStoreConformance, FailedPointsMakeItFailedAndAreTriedAgain) {
  const std::string id = submit(1, 3);
  EXPECT_FALSE(sweeps().retry(id, {}, at_second(200))->changed);
  ASSERT_TRUE(sweeps().put(claim(id, 3), {good(0), bad(1), good(2)}, at_second(60)).ok());
  EXPECT_EQ(record(id).state, JobState::failed);
  EXPECT_THAT(rows(id, {0, 9, true}), ElementsAre("1 no_convergence"));
  EXPECT_THAT(rows(id, {0, 9, false}), ElementsAre("0 [0.5]", "2 [2.5]"));
  const auto change = sweeps().retry(id, {}, at_second(200));
  EXPECT_TRUE(change->changed);
  EXPECT_EQ(change->before, JobState::failed);
  EXPECT_EQ(record(id).state, JobState::accepted);
  EXPECT_FALSE(record(id).finished);
  EXPECT_EQ((*sweeps().open(id))->document, "{\"sweep\": 1}");
  const ItemClaim again = claim(id, 3);
  EXPECT_EQ(again.items, (ItemRun{1, 1}));
  ASSERT_TRUE(sweeps().put(again, {good(1)}, at_second(70)).ok());
  EXPECT_EQ(record(id).state, JobState::successful);
  EXPECT_EQ(record(id).successful, 3);
}

/// Failures that lie apart are given out together: each claim costs a transaction, and may rewrite many rows.
TEST_P(SweepStoreConformance, ManyScatteredFailuresAreTriedAgainInFewClaims) {
  constexpr std::uint64_t kPoints = 8000;
  const auto fails = [](std::uint64_t point) { return point % 10 == 5 && (point < 2000 || point >= 6000); };
  const std::string id = submit(1, kPoints);
  for (std::uint64_t first = 0; first < kPoints; first += 2000) {
    std::vector<PointRow> all;
    const ItemClaim part = claim(id, 2000);
    for (std::uint64_t point = first; point < first + 2000; ++point) {
      all.push_back(fails(point) ? bad(point) : good(point));
    }
    ASSERT_TRUE(sweeps().put(part, all, at_second(60)).ok());
  }
  ASSERT_EQ(record(id).failed, 400);
  ASSERT_TRUE(sweeps().retry(id, {}, at_second(70))->changed);
  for (const std::uint64_t first : {5U, 6005U}) {
    const ItemClaim again = claim(id, kPoints);
    EXPECT_EQ(again.items, (ItemRun{first, 1991})) << "the points between that have rows are in the claim";
    std::vector<PointRow> rows;
    for (std::uint64_t point = first; point < first + 1991; point += 10) {
      rows.push_back(good(point));
    }
    ASSERT_TRUE(sweeps().put(again, rows, at_second(80)).ok());
  }
  EXPECT_TRUE(none_left(id) || record(id).state == JobState::successful);
  EXPECT_EQ(record(id).state, JobState::successful);
  EXPECT_EQ(record(id).successful, static_cast<std::int64_t>(kPoints));
}

TEST_P(SweepStoreConformance, OfJoinedItemsOnlyThoseWithoutARowAreGivenOutAgain) {
  const std::string id = submit(1, 9);
  ASSERT_TRUE(
      sweeps()
          .put(claim(id, 7), {good(0), bad(1), good(2), good(3), bad(4), good(5), bad(6)}, at_second(60))
          .ok());
  ASSERT_TRUE(sweeps().dismiss(id, at_second(61))->changed);
  ASSERT_TRUE(sweeps().retry(id, {}, at_second(70))->changed);
  ItemClaim again = claim(id, 9);
  if (again.items.first == 7) {  // a driver may give out apart the items that had no row
    ASSERT_TRUE(sweeps().put(again, {}, at_second(75)).ok());
    again = claim(id, 9);
  }
  ASSERT_EQ(again.items.first, 1U);
  ASSERT_TRUE(sweeps().put(again, {good(4)}, at_second(80)).ok());
  std::vector<bool> left(9);
  for (auto next = sweeps().claim(id, 1, kLease, at_second(50)); next->has_value();
       next = sweeps().claim(id, 1, kLease, at_second(50))) {
    left.at((*next)->items.first) = true;
  }
  EXPECT_THAT(left, ElementsAre(false, true, false, false, false, false, true, true, true));
}

TEST_P(SweepStoreConformance, ADismissedSweepKeepsItsRowsAndTakesNoMore) {
  const std::string id = submit(1, 3);
  ASSERT_TRUE(sweeps().put(claim(id, 1), {good(0)}, at_second(60)).ok());
  const ItemClaim held = claim(id, 1);
  EXPECT_TRUE(sweeps().dismiss(id, at_second(61))->changed);
  EXPECT_FALSE(sweeps().dismiss(id, at_second(62))->changed);
  EXPECT_EQ(sweeps().put(held, {good(1)}, at_second(63)).status().code(), StatusCode::conflict);
  EXPECT_THAT(rows(id), ElementsAre("0 [0.5]"));
  EXPECT_TRUE(sweeps().retry(id, {}, at_second(200))->changed);
  EXPECT_EQ(sweeps().put(held, {good(1)}, at_second(64)).status().code(), StatusCode::conflict)
      << "a claim from before";
  EXPECT_FALSE(sweeps().dismiss(id_number(9), at_second(1))->before);
}

TEST_P(SweepStoreConformance, PointsAreFoundByContentUnlessTheyFailed) {
  const std::string id = submit(1, 3);
  ASSERT_TRUE(sweeps().put(claim(id, 3), {good(0, "a"), good(1, "b"), bad(2)}, at_second(60)).ok());
  const auto found = sweeps().find_outputs({"b", "c", "k", "a", ""});
  ASSERT_TRUE(found.ok());
  EXPECT_THAT(*found, ElementsAre("[1.5]", std::nullopt, std::nullopt, "[0.5]", std::nullopt));
  const std::string second = submit(2, 1);
  PointRow row = good(0, "a");
  row.reused = true;
  ASSERT_TRUE(sweeps().put(claim(second, 1), {row}, at_second(61)).ok());
  EXPECT_EQ(record(second).reused, 1);
}

TEST_P(SweepStoreConformance, ItemsOfADeadProcessAreTriedAgainAlone) {
  const std::string id = submit(1, 5);
  ASSERT_TRUE(sweeps().put(claim(id, 1), {good(0)}, at_second(60)).ok());
  claim(id, 2, {"dead", at_second(90)});
  reopen();
  EXPECT_EQ(recover_sweeps(2, at_second(100)), 2);
  EXPECT_EQ(recover_sweeps(2, at_second(100)), 0) << "each death is counted once";
  ASSERT_TRUE(sweeps().put(claim(id, 9), {good(3), good(4)}, at_second(102)).ok()) << "others come first";
  EXPECT_EQ(claim(id, 9).items, (ItemRun{1, 1})) << "one at a time";
  EXPECT_EQ(claim(id, 9).items, (ItemRun{2, 1}));
}

TEST_P(SweepStoreConformance, AnItemThatKillsItsProcessTwiceIsARow) {
  const std::string id = submit(1, 2);
  for (int death = 1; death <= 2; ++death) {
    claim(id, 1, {"dead", at_second(90)});
    reopen();
    EXPECT_EQ(recover_sweeps(2, at_second(100)), death == 1 ? 1 : 0);
    if (death == 1) {
      ASSERT_TRUE(sweeps().put(claim(id, 1), {good(1)}, at_second(101)).ok());
    }
  }
  EXPECT_THAT(rows(id), ElementsAre("0 crashed", "1 [1.5]"));
  EXPECT_EQ(record(id).state, JobState::failed);
}

/// One item of thousands kills whoever has it: it is found with a few deaths, and nobody else's points fail.
TEST_P(SweepStoreConformance, OneItemOfManyThatKillsIsFound) {
  constexpr std::uint64_t kPoints = 5000;
  constexpr std::uint64_t kKiller = 1234;
  const std::string id = submit(1, kPoints);
  int deaths = 0;
  int claims = 0;
  while (!is_final(record(id).state)) {
    ASSERT_LT(++claims, 200);
    const ItemClaim held = claim(id, 2048, {"dead", at_second(90)});
    if (held.items.first <= kKiller && kKiller < held.items.first + held.items.count) {
      ++deaths;
      recover_sweeps(2, at_second(100));
      continue;
    }
    std::vector<PointRow> done;
    for (std::uint64_t i = 0; i < held.items.count; ++i) {
      done.push_back(good(held.items.first + i));
    }
    ASSERT_TRUE(sweeps().put(held, done, at_second(60)).ok());
  }
  EXPECT_EQ(deaths, 3) << "with 2048, with 32, and alone";
  EXPECT_EQ(record(id).failed, 1);
  EXPECT_EQ(record(id).successful, kPoints - 1);
  EXPECT_THAT(rows(id, {.failed = true}), ElementsAre("1234 crashed"));
}

TEST_P(SweepStoreConformance, TheFirstSweepOfEachOwnerComesFirst) {
  submit(1, 1, "ann");
  submit(2, 1, "ann");
  submit(3, 1, "bob");
  EXPECT_THAT(*sweeps().with_items(), ElementsAre(id_number(1), id_number(3), id_number(2)));
  claim(id_number(1), 1);
  EXPECT_THAT(*sweeps().with_items(), testing::UnorderedElementsAre(id_number(3), id_number(2)))
      << "others have its items";
  EXPECT_EQ(*sweeps().unfinished(), 3);
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
      sweeps().put(claim(id, 5), {good(0, "a"), good(1), good(2), good(3), good(4)}, at_second(60)).ok());
  const std::string other = submit(2, 1);
  EXPECT_TRUE(*sweeps().remove(id));
  EXPECT_FALSE(*sweeps().remove(id));
  EXPECT_FALSE(sweeps().get(id)->has_value());
  EXPECT_FALSE(sweeps().document(id)->has_value());
  EXPECT_THAT(rows(id), IsEmpty());
  int purges = 0;
  for (; purges < 9 && *sweeps().purge(2); ++purges) {
  }
  EXPECT_GE(purges, 1);
  EXPECT_LE(purges, 3);
  EXPECT_THAT(*sweeps().find_outputs({"a"}), ElementsAre(std::nullopt));
  EXPECT_EQ(record(other).points, 1);
  ASSERT_TRUE(sweeps().dismiss(other, at_second(70)).ok());
  EXPECT_EQ(*sweeps().retire(10s, at_second(80)), 0);
  EXPECT_EQ(*sweeps().retire(10s, at_second(81)), 1);
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
  ASSERT_TRUE(sweeps().forget_keys(1s, at_second(3)).ok());
  EXPECT_EQ(with_key(3, "g").kind, Submitted::Kind::created);
}

INSTANTIATE_TEST_SUITE_P(Drivers, SweepStoreConformance, testing::ValuesIn(store_drivers()), driver_name);

}  // namespace
}  // namespace snapthrough::server::test
