#pragma once
/// @file
/// Exchange between processes that share a store: each sees and announces ends, work and progress.

#include <chrono>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "server/queue/worker_context.h"
#include "server/store/neighbour_store.h"

namespace snapthrough::server {

/// @brief Polls the store during its lifetime: for work for idle workers, for ends that a thread waits for,
/// for progress that a client follows. The interval grows from 50 ms to one second while nothing is found; a
/// ring of another process ends it at once. The constructor's arguments must outlive the object.
class Neighbours {
 public:
  Neighbours(NeighbourStore& store, const WorkerContext& context);

 private:
  void watch(const std::stop_token& stop);
  void tell_others(const std::stop_token& stop);
  bool look();
  bool look_for_ends();
  bool look_for_work();
  void pass_on_progress();
  void tell_progress();

  NeighbourStore& store_;
  const WorkerContext& context_;
  double next_second_ = 0.0;
  std::jthread watching_;
  std::jthread telling_;
};

}  // namespace snapthrough::server
