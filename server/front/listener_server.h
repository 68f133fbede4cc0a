#pragma once
/// @file
/// The listener at work: its threads, connections and what they share. Only listener*.cpp include it.

#include <sys/epoll.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

#include "server/bell.h"
#include "server/descriptor.h"
#include "server/front/client.h"
#include "server/front/gateway.h"
#include "server/front/listener_data.h"
#include "server/front/shares.h"
#include "server/front/turns.h"
#include "server/jobs/memory.h"
#include "server/jobs/recent_use.h"
#include "server/status.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::server::http {

using Clock = Client::Clock;
using ClientPointer = std::shared_ptr<Client>;

/// Number of the first client in the data of epoll; smaller ones are bells.
inline constexpr std::uint64_t kFirstClient = 2;
/// Steps of one connection before other connections continue.
inline constexpr int kFairSteps = 64;
/// Time between two looks at all connections.
inline constexpr std::chrono::milliseconds kSweep{100};

/// Events that tell that a client has ended its sending side. Once it was asked whether it still waits, only
/// a reset tells more, which epoll always reports.
inline std::uint32_t end_of(const Client& client) { return client.asked ? 0U : std::uint32_t{EPOLLRDHUP}; }

/// Processor time that the calling thread has used.
inline std::chrono::nanoseconds processor_time() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

/// Repeats what needs little memory, and must not fail, until there is memory for it.
template <class Use>
auto until_memory(const Use& use) noexcept {
  while (true) {
    try {
      return use();
    } catch (const std::bad_alloc&) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
}

/// An event of a connection; its deferred response may have been dropped in the meantime.
struct Wake {
  std::uint64_t client = 0;
  std::uint64_t deferral = 0;
  Turns* turns = nullptr;  ///< not null: the client got one of these turns, and must pass it on
  std::string party = {};  ///< whose turn it is
};

/// The part of the listener that threads of one priority serve: its connections, its turns to compute
/// responses, and events of connections that wait.
struct Lane {
  Lane(int count, int of_one_party) : epoll(::epoll_create1(EPOLL_CLOEXEC)), turns(count, of_one_party) {}

  Descriptor epoll;
  Turns turns;  ///< turns to compute responses
  PollBell wakes_ready{true};
  std::mutex mutex;  ///< guards `wakes`
  std::deque<Wake> wakes;
};

class ListenerServer final : public std::enable_shared_from_this<ListenerServer> {
 public:
  ListenerServer(ListenerOptions options, Gateway& gateway);

  Status start();
  void begin_drain() { draining_ = true; }
  void shut_down();
  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] ListenerLoad load() const;

 private:
  void work(Lane& lane);
  void keep();
  void accept_all();
  void admit(Descriptor socket, const std::string& remote);
  void sweep();
  void sweep_one(const ClientPointer& client, Clock::time_point now);
  void end_idle(const ClientPointer& client, Clock::time_point now);

  template <class Use>
  void counted(const ClientPointer& client, const Use& use);
  template <class Use>
  void with_memory(const ClientPointer& client, const Use& use);
  void give_up(const ClientPointer& client);
  void event(const ClientPointer& client, std::uint32_t events);
  void attend(const ClientPointer& client, std::uint32_t events);
  void read_and_serve(const ClientPointer& client);
  bool note_incomplete(Client& client, const Received& received);
  std::optional<Response> judge_head(Client& client, const Head& head);
  bool answer(const ClientPointer& client, Received received);
  bool in_turn(const ClientPointer& client, std::function<Response()> work, std::size_t bytes);
  bool work_on(const ClientPointer& client, Turns& turns);
  Response in_its_turn(Client& client, Turns& turns);
  [[nodiscard]] std::optional<WorkEnd> is_over(Client& client, Clock::time_point start,
                                               std::chrono::nanoseconds used) const;
  [[nodiscard]] bool gives_way(const Client& client) const;
  [[nodiscard]] Turns& turns_for(const Client& client);
  void pass_turn(Turns& turns, const std::string& party) noexcept;
  bool refuse(const ClientPointer& client, const Head& head, bool linger);
  bool deliver(const ClientPointer& client, Response response);
  bool defer(const ClientPointer& client, Deferred deferred);
  bool begin_stream(const ClientPointer& client, const Response& response);
  bool begin_body(const ClientPointer& client, const Response& response);
  bool send_on(const ClientPointer& client);
  bool append_piece(const ClientPointer& client);
  bool wait_to_send(const ClientPointer& client, std::uint32_t events, Clock::time_point deadline);
  bool after_response(const ClientPointer& client);
  void linger(const ClientPointer& client);
  void pump(const ClientPointer& client);
  void woken(const Wake& wake);
  void resume(const ClientPointer& client, const Wake& wake);
  static void wake(Lane& lane, const Wake& wake) noexcept;
  void take_wake(Lane& lane);

  void drop(Client& client);
  void name_party(Client& client, std::string party);
  bool account(Client& client);
  bool add_held(const Client& client, std::size_t more, std::size_t less);
  void rearm(Client& client, std::uint32_t events);
  [[nodiscard]] ClientPointer find(std::uint64_t id) const;

  const ListenerOptions options_;
  Gateway& gateway_;
  Lane normal_;
  Lane low_;           ///< for parties that use much processor time: its threads have a low priority
  Turns large_turns_;  ///< turns for large bodies, which are worked on one at a time, at normal priority
  RecentUse use_;
  Descriptor listening_;
  PollBell end_;
  int port_ = 0;
  std::atomic<bool> draining_ = false;  ///< responses close their connections
  std::atomic<bool> stopping_ = false;
  std::atomic<Clock::time_point> stopped_at_{Clock::time_point::max()};

  mutable std::mutex table_mutex_;
  std::unordered_map<std::uint64_t, ClientPointer> clients_;
  std::uint64_t next_id_ = kFirstClient;
  std::atomic<int> streams_ = 0;
  std::atomic<std::size_t> buffered_ = 0;
  std::atomic<std::int64_t> without_memory_ = 0;
  Shares shares_;

  std::thread keeper_;
  std::vector<std::thread> threads_;
};

}  // namespace snapthrough::server::http
