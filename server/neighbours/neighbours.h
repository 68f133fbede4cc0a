#pragma once
/// @file
/// What a process does that shares its store with others: it sees what they did, and lets them know.

#include <chrono>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "server/queue/worker_context.h"
#include "server/store/neighbour_store.h"

namespace snapthrough::server {

/// @brief Looks at the store again and again for as long as it exists: for work, for idle workers; for ends
/// that somebody waits for; for progress that somebody follows. Every 50 ms, and ever more rarely, to once a
/// second, while nothing happens; at once when another process rings. The parts it is given must outlive it.
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
