#include "server/store/sqlite/parts.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include "api/stored_fields.h"
#include "server/jobs/state.h"
#include "server/store/sqlite/sqlite_store.h"
#include "tests/server/support/samples.h"
#include "tests/server/support/temp_dir.h"

namespace snapthrough::server::sqlite {
namespace {

using test::at_second;
using testing::HasSubstr;

const std::vector<Migration> kSteps{{1, "0001_first", "aa", "CREATE TABLE first (x INTEGER) STRICT"},
                                    {2, "0002_second", "bb", "CREATE TABLE second (x INTEGER) STRICT"}};

class Migrations : public testing::Test {
 protected:
  std::int64_t count(const std::string& sql) {
    Statement row = connection_.prepare(sql);
    return row.step() ? row.integer(0) : -1;
  }
  Status migrate_to(std::size_t steps, Time now = at_second(0)) {
    return migrate(connection_, std::span(kSteps).first(steps), now);
  }

  test::TempDir folder_;
  Connection connection_{folder_.file("store.db"), Access::read_write};
};

TEST_F(Migrations, AFreshStoreGetsEveryStepAndRemembersThem) {
  ASSERT_TRUE(migrate_to(2, at_second(7)).ok());
  EXPECT_EQ(count("SELECT count(*) FROM sqlite_schema WHERE name IN ('first', 'second')"), 2);
  EXPECT_EQ(count("SELECT count(*) FROM schema_migrations WHERE (version, name, checksum) IN"
                  " (VALUES (1, '0001_first', 'aa'), (2, '0002_second', 'bb'))"),
            2);
  EXPECT_EQ(count("SELECT max(applied_us) FROM schema_migrations"), at_second(7).time_since_epoch().count());
}

TEST_F(Migrations, ASecondRunChangesNothing) {
  ASSERT_TRUE(migrate_to(2, at_second(7)).ok());
  ASSERT_TRUE(migrate_to(2, at_second(9)).ok());
  EXPECT_EQ(count("SELECT max(applied_us) FROM schema_migrations"), at_second(7).time_since_epoch().count());
}

TEST_F(Migrations, AnOlderStoreGetsOnlyWhatItLacks) {
  ASSERT_TRUE(migrate_to(1, at_second(1)).ok());
  connection_.execute("INSERT INTO first VALUES (42)");
  ASSERT_TRUE(migrate_to(2, at_second(2)).ok());
  EXPECT_EQ(count("SELECT x FROM first"), 42);
  EXPECT_EQ(count("SELECT applied_us FROM schema_migrations WHERE version = 1"),
            at_second(1).time_since_epoch().count());
}

TEST_F(Migrations, ANewerStoreIsRefusedUntouched) {
  ASSERT_TRUE(migrate_to(2).ok());
  const Status status = migrate_to(1);
  EXPECT_EQ(status.code(), StatusCode::unsupported);
  EXPECT_THAT(status.message(), HasSubstr("0002_second"));
  EXPECT_EQ(count("SELECT count(*) FROM schema_migrations"), 2);
}

TEST_F(Migrations, AnEditedStepIsRefused) {
  ASSERT_TRUE(migrate_to(1).ok());
  std::vector<Migration> edited = kSteps;
  edited[0].checksum = "changed";
  EXPECT_EQ(migrate(connection_, edited, at_second(0)).code(), StatusCode::unsupported);
  EXPECT_EQ(count("SELECT count(*) FROM sqlite_schema WHERE name = 'second'"), 0);
}

TEST_F(Migrations, AStepThatFailsHalfwayLeavesNothingOfAnyStep) {
  const std::vector<Migration> broken{kSteps[0],
                                      {2, "0002_broken", "cc", "CREATE TABLE half (x); SELECT nonsense"}};
  EXPECT_THROW((void)migrate(connection_, broken, at_second(0)), Error);
  EXPECT_EQ(count("SELECT count(*) FROM sqlite_schema WHERE name = 'half'"), 0);
  EXPECT_EQ(count("SELECT count(*) FROM sqlite_schema WHERE name = 'first'"), 0);
  EXPECT_EQ(count("SELECT count(*) FROM schema_migrations"), 0);
  EXPECT_TRUE(migrate_to(2).ok());
}

TEST_F(Migrations, AStoreOfTheFirstVersionKeepsItsJobs) {
  const std::string path = folder_.file("old.db");
  {
    Connection old(path, Access::read_write);
    ASSERT_TRUE(migrate(old, std::span(embedded_migrations()).first(1), at_second(0)).ok());
    for (const char* row :
         {"1, 'accepted', 0, NULL, NULL", "2, 'running', 1, 5, NULL", "3, 'dismissed', 0, NULL, 6"}) {
      const std::string values(row);
      old.execute(
          "INSERT INTO jobs (id, seq, status, attempt, started_us, finished_us, analysis_type, created_us)"
          " VALUES ('" +
          test::id_number(values[0] - '0') + "', " + values + ", 'path', 1)");
      old.execute("INSERT INTO requests VALUES (" + values.substr(0, 1) + ", '{}')");
    }
  }
  auto opened = open_store(path, at_second(1));
  ASSERT_TRUE(opened.ok()) << opened.status().message();
  const std::unique_ptr<Store> store = std::move(opened).value();
  EXPECT_THAT(store->recover(3, at_second(2))->requeued, testing::ElementsAre(test::id_number(2)));
  EXPECT_EQ((*store->get(test::id_number(3)))->state, JobState::dismissed);
  EXPECT_EQ((*store->claim({"worker", at_second(9)}, at_second(3)))->id, test::id_number(1));
}

TEST_F(Migrations, AStoreWithoutLabelsKeepsItsListsAndItsSweepsGetTheirAnalysis) {
  const std::string path = folder_.file("old.db");
  {
    Connection old(path, Access::read_write);
    ASSERT_TRUE(migrate(old, std::span(embedded_migrations()).first(4), at_second(0)).ok());
    old.execute("INSERT INTO jobs (id, analysis_type, created_us) VALUES ('" + test::id_number(1) +
                "', 'path', 1)");
    old.execute("INSERT INTO sweeps (seq, id, points, created_us) VALUES (7, '" + test::id_number(2) +
                "', 3, 1)");
    old.execute(R"(INSERT INTO sweep_documents VALUES (7, '{"model": {}, "analysis": {"type": "static"}}'))");
  }
  auto opened = open_store(path, at_second(1));
  ASSERT_TRUE(opened.ok()) << opened.status().message();
  const std::unique_ptr<Store> store = std::move(opened).value();
  EXPECT_EQ(store->list({})->jobs.at(0).annotations, Annotations{});
  EXPECT_EQ(store->sweeps().list({})->sweeps.at(0).analysis_type, "static");
}

TEST_F(Migrations, PathsOfAStoreWithoutStoredFieldsStayReadable) {
  const std::string path = folder_.file("old.db");
  {
    Connection old(path, Access::read_write);
    ASSERT_TRUE(migrate(old, std::span(embedded_migrations()).first(10), at_second(0)).ok());
    old.execute("INSERT INTO jobs (id, analysis_type, created_us) VALUES ('" + test::id_number(1) +
                "', 'path', 1)");
    old.execute("INSERT INTO branches VALUES (1, 0, NULL, 0, x'', x'', x'', NULL)");
    old.execute("INSERT INTO critical_points VALUES (1, 0, 0, 'limit_max', 2.5, NULL, 1.5, 0, 1, 1, NULL)");
  }
  auto opened = open_store(path, at_second(1));
  ASSERT_TRUE(opened.ok()) << opened.status().message();
  const auto stored = (*opened)->path(test::id_number(1));
  ASSERT_TRUE(stored.ok()) << stored.status().message();
  EXPECT_EQ(stored->branches.size(), 1U);
  ASSERT_EQ(stored->critical_points.size(), 1U);
  EXPECT_EQ(stored->critical_points[0].load_factor, 2.5);
  EXPECT_EQ(api::stored_fields(stored->critical_points[0]), api::stored_fields(CriticalPoint{}));
}

TEST_F(Migrations, TheStoreReportsANewerSchema) {
  const std::string path = folder_.file("newer.db");
  ASSERT_TRUE(open_store(path, at_second(0)).ok());
  Connection(path, Access::read_write)
      .execute("INSERT INTO schema_migrations VALUES (9999, '9999_future', 'x', 0)");
  const auto opened = open_store(path, at_second(0));
  EXPECT_EQ(opened.status().code(), StatusCode::unsupported);
  EXPECT_THAT(opened.status().message(), HasSubstr("newer version"));
}

TEST_F(Migrations, OneProcessHasAStoreByWhateverNameItIsOpened) {
  const std::string path = folder_.file("store.db");
  const auto first = open_store(path, at_second(0));
  ASSERT_TRUE(first.ok());
  ASSERT_EQ(::symlink(path.c_str(), folder_.file("symbolic.db").c_str()), 0);
  ASSERT_EQ(::link(path.c_str(), folder_.file("hard.db").c_str()), 0);
  for (const char* name : {"store.db", "symbolic.db", "hard.db"})
    EXPECT_EQ(open_store(folder_.file(name), at_second(0)).status().code(), StatusCode::unavailable) << name;
}

TEST_F(Migrations, AFileThatIsNoDatabaseIsRefused) {
  const std::string path = folder_.file("text.db");
  std::FILE* file = std::fopen(path.c_str(), "w");
  std::fputs(
      "This is certainly not a database; it is longer than a header, too, by a good margin of bytes...",
      file);
  std::fclose(file);
  EXPECT_EQ(open_store(path, at_second(0)).status().code(), StatusCode::unsupported);
}

TEST_F(Migrations, EmbeddedStepsAreNumberedWithoutGapsAndHaveChecksums) {
  int expected = 1;
  for (const Migration& step : embedded_migrations()) {
    EXPECT_EQ(step.version, expected++);
    EXPECT_EQ(step.checksum.size(), 64U);
    EXPECT_EQ(std::stoi(std::string(step.name.substr(0, 4))), step.version);
  }
  EXPECT_GE(expected, 2);
}

class Schema : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(migrate(connection_, embedded_migrations(), at_second(0)).ok()); }
  bool accepts(const std::string& status, int attempt, const std::string& started,
               const std::string& finished) {
    try {
      connection_.execute(
          "INSERT INTO jobs (id, status, attempt, analysis_type, created_us, started_us,"
          " finished_us) VALUES ('" +
          test::id_number(++number_) + "', '" + status + "', " + std::to_string(attempt) + ", 'path', 1, " +
          started + ", " + finished + ")");
      return true;
    } catch (const Error&) {
      return false;
    }
  }

  test::TempDir folder_;
  Connection connection_{folder_.file("store.db"), Access::read_write};
  int number_ = 0;
};

TEST_F(Schema, KnowsTheStatesOfTheTableAndNoOthers) {
  for (const JobState state : kJobStates) {
    const bool waiting = state == JobState::accepted;
    EXPECT_TRUE(accepts(std::string(to_string(state)), waiting ? 0 : 1, waiting ? "NULL" : "2",
                        is_final(state) ? "3" : "NULL"))
        << to_string(state);
  }
  EXPECT_FALSE(accepts("paused", 1, "2", "NULL"));
}

TEST_F(Schema, RefusesTimesThatDoNotFitTheState) {
  EXPECT_FALSE(accepts("successful", 1, "2", "NULL"));
  EXPECT_FALSE(accepts("running", 1, "2", "3"));
  EXPECT_FALSE(accepts("running", 1, "NULL", "NULL"));
  EXPECT_FALSE(accepts("accepted", 1, "2", "NULL"));
  EXPECT_FALSE(accepts("running", 0, "2", "NULL"));
}

TEST_F(Schema, RefusesASeriesOfAnotherLength) {
  ASSERT_TRUE(accepts("running", 1, "2", "NULL"));
  EXPECT_THROW(connection_.execute("INSERT INTO branches VALUES (1, 0, NULL, 2, x'0011', x'0011', x'0011')"),
               Error);
}

TEST_F(Migrations, UnfinishedSweepsOfTheEighthVersionGoOnWhereTheyWere) {
  const std::string path = folder_.file("old.db");
  {
    Connection old(path, Access::read_write);
    ASSERT_TRUE(migrate(old, std::span(embedded_migrations()).first(8), at_second(0)).ok());
    const auto add = [&](int number, const std::string& state, int points, const std::string& document) {
      old.execute(
          "INSERT INTO sweeps (id, seq, status, points, created_us, successful, finished_us) VALUES ('" +
          test::id_number(number) + "', " + std::to_string(number) + ", '" + state + "', " +
          std::to_string(points) + ", 1, 3, " + (state == "dismissed" ? "2" : "NULL") + ")");
      old.run("INSERT INTO sweep_documents VALUES (?, ?)", number, document);
      for (const int point : {0, 1, 3}) {
        old.run("INSERT INTO sweep_points (sweep, point, outputs) VALUES (?, ?, '[1]')", number, point);
      }
    };
    add(1, "running", 6, "{}");
    add(2, "dismissed", 4, "{}");
    add(3, "running", 6,
        R"({"follow": "k", "parameters": [{"values": [1, 2, 3]}, {"name": "k", "values": [1, 2]}]})");
    add(4, "running", 6, R"({"follow": "k", "parameters": [{"range": {"from": 1, "to": 2, "count": 3}}]})");
    old.execute("INSERT INTO sweep_claims (sweep, points) VALUES (1, x'')");
  }
  auto opened = open_store(path, at_second(1));
  ASSERT_TRUE(opened.ok()) << opened.status().message();
  SweepStore& sweeps = (*opened)->sweeps();
  ASSERT_TRUE(sweeps.retry(test::id_number(2), {}, test::at_second(200))->changed);
  const auto left = [&](int number) {
    std::vector<std::string> runs;
    for (;;) {
      const auto claim = sweeps.claim(test::id_number(number), 9, {"w", at_second(9)}, at_second(1));
      if (!claim.ok() || !*claim) {
        return runs;
      }
      runs.push_back(std::to_string((*claim)->items.first) + "+" + std::to_string((*claim)->items.count));
    }
  };
  EXPECT_THAT(left(1), testing::ElementsAre("2+1", "4+2"));
  EXPECT_THAT(left(2), testing::ElementsAre("2+1"));
  EXPECT_THAT(left(3), testing::ElementsAre("1+2")) << "curves of two points";
  EXPECT_THAT(left(4), testing::ElementsAre("0+2")) << "curves of three";
}

}  // namespace
}  // namespace snapthrough::server::sqlite
