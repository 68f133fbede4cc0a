/// @file
/// The order in which workers get the jobs of several owners.

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "tests/server/support/samples.h"
#include "tests/server/support/store_driver.h"

namespace snapthrough::server::test {
namespace {

using testing::ElementsAre;

const Lease kLease{"worker", at_second(1'000'000)};

class ClaimTurns : public StoreTest {
 protected:
  /// Adds jobs 0, 1, ... of these owners.
  void submit(const std::vector<std::string>& owners) {
    for (std::size_t i = 0; i < owners.size(); ++i) {
      NewJob job = new_job(id_number(static_cast<int>(i)));
      job.owner = owners[i];
      ASSERT_TRUE(store_->submit(job).ok());
    }
  }
  /// Ids of the jobs that are claimed, until there are none or `most` have been.
  std::vector<std::string> claimed(const OwnersInTurn& owners, std::size_t most = 100) {
    std::vector<std::string> ids;
    while (ids.size() < most) {
      const auto claim = store_->claim(kLease, at_second(1), owners);
      if (!claim.ok() || !*claim) {
        break;
      }
      ids.push_back((*claim)->id);
    }
    return ids;
  }
};

TEST_P(ClaimTurns, OwnersTakeTurns) {
  submit({"ann", "ann", "ann", "bob", "bob", "cid"});
  EXPECT_THAT(claimed(OwnersInTurn{}), ElementsAre(id_number(0), id_number(3), id_number(5), id_number(1),
                                                   id_number(4), id_number(2)));
}

TEST_P(ClaimTurns, OwnersWithoutARunningJobCanHaveTheirTurnAlone) {
  submit({"ann", "ann", "bob", "bob", "cid"});
  EXPECT_THAT(claimed(OwnersInTurn{}, 1), ElementsAre(id_number(0)));
  EXPECT_THAT(claimed(OwnersInTurn{1}), ElementsAre(id_number(2), id_number(4)));
  EXPECT_THAT(claimed(OwnersInTurn{}), ElementsAre(id_number(1), id_number(3))) << "the others are left";
}

TEST_P(ClaimTurns, OwnersWithFewRunningJobsCanHaveTheirTurnAlone) {
  submit({"ann", "ann", "ann", "bob", "bob", "bob"});
  EXPECT_THAT(claimed(OwnersInTurn{}, 1), ElementsAre(id_number(0)));
  EXPECT_THAT(claimed(OwnersInTurn{2}), ElementsAre(id_number(3), id_number(1), id_number(4)));
  EXPECT_THAT(claimed(OwnersInTurn{}), ElementsAre(id_number(2), id_number(5))) << "the others are left";
}

TEST_P(ClaimTurns, TheWorkOfSomeOwnersCanBeLeftToOthers) {
  submit({"ann", "ann", "bob", "cid", "it's"});
  EXPECT_THAT(claimed({1, {"ann", "it's"}}), ElementsAre(id_number(2), id_number(3)));
  EXPECT_THAT(claimed({}), ElementsAre(id_number(4), id_number(0), id_number(1)));
}

INSTANTIATE_TEST_SUITE_P(Drivers, ClaimTurns, testing::ValuesIn(store_drivers()), driver_name);

}  // namespace
}  // namespace snapthrough::server::test
