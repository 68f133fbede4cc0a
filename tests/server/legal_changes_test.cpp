/// @file
/// Every event in every state, on every driver: a legal change happens, any other is refused.

#include <gmock/gmock.h>

#include "server/jobs/sweep_state.h"
#include "tests/server/support/samples.h"
#include "tests/server/support/store_driver.h"

namespace snapthrough::server::test {
namespace {

/// Longer than any test.
const Lease kLease{"worker", at_second(1'000'000)};

class LegalChanges : public StoreTest {
 protected:
  /// Whether a fenced verb was done; it may refuse only by `conflict`.
  static bool done(const Status& status) {
    EXPECT_TRUE(status.ok() || status.code() == StatusCode::conflict) << status.message();
    return status.ok();
  }

  /// A job in that state, and the claim that it was given, if any; else a claim of no attempt.
  Claim job_in(JobState state, int number) {
    EXPECT_TRUE(store_->submit(new_job(id_number(number))).ok());
    Claim held{id_number(number), 0};
    if (state == JobState::accepted) {
      return held;
    }
    if (state == JobState::dismissed) {
      EXPECT_TRUE(store_->dismiss(held.id, at_second(2)).ok());
      return held;
    }
    held = store_->claim(kLease, at_second(2))->value();
    if (state == JobState::successful) {
      EXPECT_TRUE(store_->finish(held, sample_result(), at_second(3)).ok());
    }
    if (state == JobState::failed) {
      EXPECT_TRUE(store_->fail(held, {"no_convergence", "why", ""}, {}, at_second(3)).ok());
    }
    return held;
  }
  /// Whether the event was accepted.
  bool happens(JobEvent event, const Claim& held) {
    switch (event) {
      case JobEvent::claim:
        return store_->claim(kLease, at_second(4))->has_value();
      case JobEvent::finish:
        return done(store_->finish(held, sample_result(), at_second(4)));
      case JobEvent::fail:
        return done(store_->fail(held, {"no_convergence", "why", ""}, {}, at_second(4)));
      case JobEvent::requeue:
        return done(store_->requeue(held));
      case JobEvent::dismiss: {
        const Dismissal dismissal = *store_->dismiss(held.id, at_second(4));
        return next_state(dismissal.before, event).has_value();
      }
    }
    return false;
  }

  SweepStore& sweeps() { return store_->sweeps(); }
  static std::vector<PointRow> rows(const ItemRun& items, bool failed) {
    std::vector<PointRow> all;
    for (std::uint64_t point = items.first; point < items.first + items.count; ++point) {
      all.push_back({point, failed ? api::PointOutcome{"", "no_convergence", "why"}
                                   : api::PointOutcome{"[1]", "", ""}});
    }
    return all;
  }
  /// Claims what is left of a sweep of two points.
  std::optional<ItemClaim> claim_rest(const std::string& id) {
    const auto claim = sweeps().claim(id, 9, kLease, at_second(2));
    EXPECT_TRUE(claim.ok() || claim.status().code() == StatusCode::conflict) << claim.status().message();
    return claim.ok() ? *claim : std::nullopt;
  }
  /// A sweep of two points in that state, and a claim of its first point; it holds while the sweep is
  /// running.
  ItemClaim sweep_in(JobState state, int number) {
    NewSweep sweep{id_number(number), "a title", "{}", 2, at_second(1)};
    EXPECT_TRUE(sweeps().submit(sweep).ok());
    ItemClaim held{12345, sweep.id, {0, 1}};
    if (state == JobState::accepted) {
      return held;
    }
    held = sweeps().claim(sweep.id, 1, kLease, at_second(2))->value();
    if (state == JobState::dismissed) {
      EXPECT_TRUE(sweeps().dismiss(sweep.id, at_second(3))->changed);
    } else if (state != JobState::running) {
      const ItemClaim rest = claim_rest(sweep.id).value();
      EXPECT_TRUE(sweeps().put(rest, rows(rest.items, state == JobState::failed), at_second(3)).ok());
      EXPECT_TRUE(sweeps().put(held, rows(held.items, false), at_second(3)).ok());
    }
    return held;
  }
  bool happens(SweepEvent event, const ItemClaim& held) {
    switch (event) {
      case SweepEvent::claim:
        return claim_rest(held.sweep).has_value();
      case SweepEvent::finish:
      case SweepEvent::fail: {
        const bool failed = event == SweepEvent::fail;
        const auto first = sweeps().put(held, rows(held.items, failed), at_second(4));
        if (!done(first.status())) {
          return false;
        }
        const ItemClaim rest = claim_rest(held.sweep).value();
        return done(sweeps().put(rest, rows(rest.items, false), at_second(4)).status());
      }
      case SweepEvent::dismiss:
        return sweeps().dismiss(held.sweep, at_second(4))->changed;
      case SweepEvent::retry:
        return sweeps().retry(held.sweep, {}, at_second(4))->changed;
    }
    return false;
  }
};

TEST_P(LegalChanges, OfAJobHappenAndOthersAreRefused) {
  int number = 0;
  for (const JobState state : kJobStates) {
    for (std::size_t event = 0; event < kJobEventNames.size(); ++event) {
      SCOPED_TRACE(std::string(kJobEventNames[event]) + " " + std::string(to_string(state)));
      const Claim held = job_in(state, ++number);
      ASSERT_EQ((*store_->get(held.id))->state, state);
      const auto next = next_state(state, static_cast<JobEvent>(event));
      EXPECT_EQ(happens(static_cast<JobEvent>(event), held), next.has_value());
      EXPECT_EQ((*store_->get(held.id))->state, next.value_or(state));
      ASSERT_TRUE(*store_->remove(held.id));  // so that the next claim finds the next job
    }
  }
}

TEST_P(LegalChanges, OfASweepHappenAndOthersAreRefused) {
  int number = 0;
  for (const JobState state : kJobStates) {
    for (std::size_t event = 0; event < kSweepEventNames.size(); ++event) {
      SCOPED_TRACE(std::string(kSweepEventNames[event]) + " " + std::string(to_string(state)));
      const ItemClaim held = sweep_in(state, ++number);
      ASSERT_EQ((*sweeps().get(held.sweep))->state, state);
      const auto next = next_state(state, static_cast<SweepEvent>(event));
      EXPECT_EQ(happens(static_cast<SweepEvent>(event), held), next.has_value());
      EXPECT_EQ((*sweeps().get(held.sweep))->state, next.value_or(state));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Drivers, LegalChanges, testing::ValuesIn(store_drivers()), driver_name);

}  // namespace
}  // namespace snapthrough::server::test
