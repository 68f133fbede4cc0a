/// @file
/// What every driver of the store must do with callbacks: each end of a job or sweep is a delivery.

#include <gmock/gmock.h>

#include "tests/server/support/samples.h"
#include "tests/server/support/store_driver.h"

namespace snapthrough::server::test {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

const std::string kOrigin = "https://hooks.example:8443";
const std::string kAddress = kOrigin + "/a?b=c//d";
const Lease kLease{"worker", at_second(1'000'000)};

class DeliveryStoreConformance : public StoreTest {
 protected:
  DeliveryStore& deliveries() { return store_->deliveries(); }
  NewJob job(int number) {
    NewJob job = new_job(id_number(number), number);
    job.annotations.callback = kAddress;
    return job;
  }
  void add_job(int number) { ASSERT_TRUE(store_->submit(job(number)).ok()); }
  Claim claim() { return **store_->claim(kLease, at_second(100)); }
  void add_sweep(int number, int points) {
    NewSweep sweep{id_number(number), "", "{}", points, at_second(number)};
    sweep.annotations.callback = kAddress;
    ASSERT_TRUE(store_->sweeps().submit(sweep).ok());
  }
  void put(int sweep, std::uint64_t point, const std::string& code = "") {
    const auto claimed = store_->sweeps().claim(id_number(sweep), 1, kLease, at_second(5));
    ASSERT_TRUE(claimed.ok() && *claimed && (*claimed)->items.first == point);
    const PointRow row{point, {code.empty() ? "[1]" : "", code, code}};
    ASSERT_TRUE(store_->sweeps().put(**claimed, {row}, at_second(6)).ok());
  }
  std::optional<Delivery> next(int second = 1000, const std::string& origin = kOrigin) {
    const auto found = deliveries().next(origin, 0ms, at_second(second));
    EXPECT_TRUE(found.ok()) << found.status().message();
    return found.ok() ? *found : std::nullopt;
  }
  std::string next_id() { return next() ? next()->id : ""; }
  std::int64_t waiting() { return *deliveries().waiting(); }
};

TEST_P(DeliveryStoreConformance, EveryVerbThatEndsAJobAddsADelivery) {
  for (int number = 1; number <= 6; ++number) {
    add_job(number);
  }
  ASSERT_TRUE(store_->finish(claim(), sample_result(), at_second(201)).ok());
  ASSERT_TRUE(store_->fail(claim(), {"no_convergence", "why", ""}, {}, at_second(202)).ok());
  ASSERT_TRUE(store_->dismiss(id_number(3), at_second(203)).ok());
  (void)store_->claim({"dead", at_second(150)}, at_second(100));
  EXPECT_EQ(waiting(), 3);
  EXPECT_EQ(recover(1, at_second(204)).failed.size(), 1U);
  (void)store_->claim({"another", at_second(150)}, at_second(100));
  EXPECT_EQ(store_->rescue("worker", 1, at_second(205))->failed.size(), 1U);
  ASSERT_TRUE(store_->requeue(claim()).ok());
  EXPECT_EQ(waiting(), 5) << "one that goes back to the queue has not ended";
  for (int number = 1; number <= 5; ++number) {
    const std::optional<Delivery> delivery = next();
    ASSERT_TRUE(delivery);
    EXPECT_EQ(delivery->id, id_number(number));
    EXPECT_EQ(delivery->address, kAddress);
    EXPECT_FALSE(delivery->sweep);
    EXPECT_EQ(delivery->attempts, 0);
    ASSERT_TRUE(deliveries().remove(delivery->number).ok());
  }
  EXPECT_FALSE(next());
}

TEST_P(DeliveryStoreConformance, AJobWithoutACallbackAddsNothing) {
  ASSERT_TRUE(store_->submit(new_job(id_number(1))).ok());
  ASSERT_TRUE(store_->dismiss(id_number(1), at_second(3)).ok());
  EXPECT_EQ(waiting(), 0);
}

TEST_P(DeliveryStoreConformance, AKnownResultIsToldOfANewJobEachTime) {
  NewJob first = job(1);
  first.content_key = "content";
  ASSERT_TRUE(store_->submit(first).ok());
  ASSERT_TRUE(store_->finish(claim(), sample_result(), at_second(201)).ok());
  for (int number = 2; number <= 3; ++number) {
    NewJob again = job(number);
    again.content_key = "content";
    again.reuse = true;
    EXPECT_EQ(store_->submit(again)->kind, Submitted::Kind::copied);
    EXPECT_EQ(waiting(), number);
  }
  EXPECT_EQ((*store_->get(id_number(3)))->annotations.callback, kAddress);
}

TEST_P(DeliveryStoreConformance, WhatIsDueIsGivenByOriginTheOldestFirst) {
  add_job(1);
  NewJob other = job(2);
  other.annotations.callback = "http://[::1]:80/";
  ASSERT_TRUE(store_->submit(other).ok());
  ASSERT_TRUE(store_->dismiss(id_number(1), at_second(50)).ok());
  ASSERT_TRUE(store_->dismiss(id_number(2), at_second(40)).ok());
  EXPECT_FALSE(next(49));
  EXPECT_EQ(next(50)->id, id_number(1));
  EXPECT_EQ(next(40, "http://[::1]:80")->id, id_number(2));
  for (const char* none :
       {"https://hooks.example", "https://hooks.example:84430", "http://hooks.example:8443", ""}) {
    EXPECT_FALSE(next(50, none)) << none;
  }
}

TEST_P(DeliveryStoreConformance, WhatIsUnderWayAndOwnersThatHaveTheirPartAreLeftOut) {
  for (int number = 1; number <= 3; ++number) {
    NewJob owned = job(number);
    owned.owner = number == 2 ? "bob \"}, {" : "ann";
    ASSERT_TRUE(store_->submit(owned).ok());
    ASSERT_TRUE(store_->dismiss(id_number(number), at_second(50 + number)).ok());
  }
  const auto next_but = [&](const UnderWay& under_way) {
    const auto found = deliveries().next(kOrigin, under_way, 0ms, at_second(1000));
    EXPECT_TRUE(found.ok()) << found.status().message();
    return found.ok() && *found ? **found : Delivery{};
  };
  const Delivery first = next_but({});
  EXPECT_EQ(first.id, id_number(1));
  EXPECT_EQ(first.owner, "ann");
  const Delivery second = next_but({{first.number}, {}});
  EXPECT_EQ(second.id, id_number(2));
  EXPECT_EQ(next_but({{}, {"ann"}}).id, id_number(2));
  EXPECT_EQ(next_but({{first.number}, {second.owner}}).id, id_number(3));
  EXPECT_EQ(next_but({{second.number}, {"ann", "nobody"}}).id, "");
}

TEST_P(DeliveryStoreConformance, AnAttemptThatFailedIsKeptWithItsNumber) {
  add_job(1);
  ASSERT_TRUE(store_->dismiss(id_number(1), at_second(50)).ok());
  const std::int64_t number = next(50)->number;
  ASSERT_TRUE(deliveries().postpone(number, 20s, at_second(60)).ok());
  reopen();
  EXPECT_FALSE(next(79));
  EXPECT_EQ(next(80)->number, number);
  EXPECT_EQ(next(80)->attempts, 1);
}

TEST_P(DeliveryStoreConformance, ADeliveryGoesWithItsJob) {
  add_job(1);
  add_job(2);
  ASSERT_TRUE(store_->dismiss(id_number(1), at_second(50)).ok());
  ASSERT_TRUE(store_->dismiss(id_number(2), at_second(60)).ok());
  ASSERT_TRUE(*store_->remove(id_number(1)));
  EXPECT_EQ(next_id(), id_number(2));
  EXPECT_EQ(*store_->retire(1s, 10, at_second(62)), 1);
  EXPECT_EQ(waiting(), 0);
}

TEST_P(DeliveryStoreConformance, ASweepIsToldOncePerEnd) {
  add_sweep(1, 2);
  put(1, 0);
  EXPECT_EQ(waiting(), 0);
  put(1, 1, "no_convergence");
  const std::optional<Delivery> failed = next();
  ASSERT_TRUE(failed);
  EXPECT_TRUE(failed->sweep);
  EXPECT_EQ(failed->id, id_number(1));
  EXPECT_EQ((*store_->sweeps().get(id_number(1)))->annotations.callback, kAddress);
  ASSERT_TRUE(store_->sweeps().retry(id_number(1), {}, at_second(200))->changed);
  EXPECT_EQ(waiting(), 0) << "it has not ended any more";
  put(1, 1);
  EXPECT_EQ(waiting(), 1);
  EXPECT_NE(next()->number, failed->number);
  ASSERT_TRUE(*store_->sweeps().remove(id_number(1)));
  EXPECT_EQ(waiting(), 0);
}

TEST_P(DeliveryStoreConformance, DismissedAndCrashedSweepsAreTold) {
  add_sweep(1, 2);
  add_sweep(2, 1);
  ASSERT_TRUE(store_->sweeps().dismiss(id_number(1), at_second(7))->changed);
  EXPECT_EQ(next_id(), id_number(1));
  ASSERT_TRUE(store_->sweeps().claim(id_number(2), 1, {"dead", at_second(8)}, at_second(8)).ok());
  recover_sweeps(1, at_second(9));
  EXPECT_EQ(waiting(), 2);
}

INSTANTIATE_TEST_SUITE_P(Drivers, DeliveryStoreConformance, testing::ValuesIn(store_drivers()), driver_name);

}  // namespace
}  // namespace snapthrough::server::test
