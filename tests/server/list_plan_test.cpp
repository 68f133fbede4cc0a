/// @file
/// How lists are found: whatever is filtered by, in an index and in its order.

#include <gmock/gmock.h>

#include "server/store/sqlite/list.h"
#include "server/store/sqlite/parts.h"
#include "server/store/sqlite/sqlite_store.h"
#include "tests/server/support/samples.h"
#include "tests/server/support/temp_dir.h"

namespace snapthrough::server::sqlite {
namespace {

using testing::HasSubstr;
using testing::Not;

class ListPlan : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(migrate(connection_, embedded_migrations(), test::at_second(0)).ok()); }
  void expect_found_in_an_index(const ListedTable& table, const ListQuery& query) {
    Statement plan = connection_.prepare("EXPLAIN QUERY PLAN " + list_sql(table, query));
    std::string filters = "(owner=?";
    filters += query.label ? " AND label=?" : "";
    filters += query.analysis ? " AND analysis_type=?" : "";
    filters += " AND status=? AND created_us>? AND created_us<?)";
    int runs = 0;
    while (plan.step()) {
      const std::string step = plan.text(3);
      EXPECT_THAT(step, Not(HasSubstr("SCAN")));
      EXPECT_THAT(step, Not(HasSubstr("TEMP B-TREE")));  // a sort of all that match
      if (step == "SEARCH failures USING INTEGER PRIMARY KEY (rowid=?)") {
        continue;  // why a job that is listed failed
      }
      if (step.starts_with("SEARCH")) {
        ++runs;
        EXPECT_THAT(step, HasSubstr(filters));
      }
    }
    EXPECT_EQ(runs, query.state ? 1 : static_cast<int>(kJobStates.size()));
  }

  test::TempDir folder_;
  Connection connection_{folder_.file("store.db"), Access::read_write};
};

/// status=running among a million jobs walked all of them.
TEST_F(ListPlan, EverySetOfFiltersIsFoundInAnIndexAndNothingIsSorted) {
  for (const ListedTable& table :
       {ListedTable{"jobs", kJobColumns, kJobColumnCount, ""},
        ListedTable{"sweeps", kSweepColumns, kSweepColumnCount, " AND removed = 0"}}) {
    for (int filters = 0; filters < 8; ++filters) {
      SCOPED_TRACE(std::string(table.name) + " " + std::to_string(filters));
      ListQuery query;
      if ((filters & 1) != 0) query.state = JobState::running;
      if ((filters & 2) != 0) query.label = "a";
      if ((filters & 4) != 0) query.analysis = "path";
      expect_found_in_an_index(table, query);
    }
  }
}

TEST_F(ListPlan, AFilterWithoutAnIndexWouldBeNoticed) {
  connection_.execute("DROP INDEX jobs_by_label; DROP INDEX jobs_by_label_and_analysis");
  ListQuery query;
  query.label = "a";
  Statement plan = connection_.prepare("EXPLAIN QUERY PLAN " +
                                       list_sql({"jobs", kJobColumns, kJobColumnCount, ""}, query));
  std::string text;
  while (plan.step()) {
    text += plan.text(3) + "\n";
  }
  EXPECT_THAT(text, Not(HasSubstr("label=?")));
}

}  // namespace
}  // namespace snapthrough::server::sqlite
