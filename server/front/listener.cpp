#include "server/front/listener.h"

#include <poll.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <ctime>
#include <deque>
#include <mutex>
#include <system_error>
#include <thread>
#include <unordered_map>
#include <utility>
#include <vector>

#include "server/bell.h"
#include "server/front/client.h"
#include "server/front/response_bytes.h"
#include "server/front/shares.h"
#include "server/front/sockets.h"
#include "server/front/turns.h"
#include "server/jobs/memory.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::server::http {
namespace {

using Clock = Client::Clock;
using ClientPointer = std::shared_ptr<Client>;

constexpr std::uint64_t kWakes = 0;  ///< epoll data; clients are numbered from kFirstClient
constexpr std::uint64_t kEnd = 1;
constexpr std::uint64_t kFirstClient = 2;
/// Steps of one connection before other connections continue.
constexpr int kFairSteps = 64;
constexpr std::chrono::milliseconds kSweep{100};
constexpr std::chrono::milliseconds kLinger{500};
/// Threads in addition to those that compute responses, so that immediate answers do not wait for them.
constexpr int kAttending = 2;
/// Number of threads for the one turn of large bodies, in addition to the others.
constexpr int kForLarge = 1;
/// Responses below this size in bytes are always sent.
constexpr std::size_t kSmallResponse = 64 * 1024;
/// One party has at most a part of what all share: half of the memory, a quarter of the turns and streams.
constexpr std::size_t kPartOfMemory = 2;
constexpr int kPartOfTurns = 4;
constexpr int kPartOfStreams = 4;
/// Time after which reading ends when its client has gone, counted from its begin, or when the service is
/// about to end, counted from the stop.
constexpr std::chrono::milliseconds kAbandoned{1'000};
/// Longest time that reading may take, over the bound of its processor time (ClientTimes::reading): a busy
/// machine gives a thread a part of the time only.
constexpr int kBusy = 6;
constexpr std::string_view kTooMany =
    "HTTP/1.1 503 Service Unavailable\r\nRetry-After: 5\r\nContent-Type: application/problem+json\r\n"
    "Content-Length: 153\r\nConnection: close\r\n\r\n"
    R"({"type":"urn:snapthrough:problem:too-many-connections","title":"Too many connections","status":503,)"
    R"("detail":"As many connections are open as are taken."})";

std::chrono::nanoseconds processor_time() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

/// An event of a connection; its deferred response may have been dropped in the meantime.
struct Wake {
  std::uint64_t client = 0;
  std::uint64_t deferral = 0;
  Turns* turns = nullptr;  ///< not null: the client got one of these turns, and must pass it on
  std::string party = {};  ///< whose turn it is
};

}  // namespace

class Listener::Server final : public std::enable_shared_from_this<Listener::Server> {
 public:
  Server(ListenerOptions options, Gateway& gateway)
      : options_(std::move(options)),
        gateway_(gateway),
        turns_(options_.threads, std::max(1, options_.threads / kPartOfTurns)),
        large_turns_(1, 1),
        epoll_(::epoll_create1(EPOLL_CLOEXEC)) {
    watch(wakes_ready_.descriptor(), kWakes, EPOLLIN, EPOLL_CTL_ADD);
    watch(end_.descriptor(), kEnd, EPOLLIN, EPOLL_CTL_ADD);
  }

  Status start();
  void shut_down();
  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] ListenerLoad load() const;

 private:
  void work();
  void keep();
  void accept_all();
  void sweep();
  void sweep_one(const ClientPointer& client, Clock::time_point now);

  void attend(const ClientPointer& client, std::uint32_t events);
  void read_and_serve(const ClientPointer& client);
  bool note_incomplete(Client& client, const Received& received);
  std::optional<Response> judge_head(Client& client, const Head& head);
  bool answer(const ClientPointer& client, Received received);
  bool in_turn(const ClientPointer& client, std::function<Response()> work, std::size_t bytes);
  bool work_on(const ClientPointer& client);
  [[nodiscard]] bool is_over(const Client& client, Clock::time_point start,
                             std::chrono::nanoseconds used) const;
  [[nodiscard]] Turns& turns_for(const Client& client) {
    return client.work_bytes > LargeDocument::kSmall ? large_turns_ : turns_;
  }
  void pass_turn(Turns& turns, const std::string& party);
  bool refuse(const ClientPointer& client, const Head& head, bool linger);
  bool deliver(const ClientPointer& client, Response response);
  bool defer(const ClientPointer& client, Deferred deferred);
  bool begin_stream(const ClientPointer& client, const Response& response);
  bool begin_body(const ClientPointer& client, const Response& response);
  bool send_on(const ClientPointer& client);
  bool append_piece(const ClientPointer& client);
  bool wait_to_send(const ClientPointer& client, std::uint32_t events, Clock::time_point deadline);
  bool after_response(const ClientPointer& client);
  void pump(const ClientPointer& client);
  void woken(const Wake& wake);
  void wake(const Wake& wake);
  void take_wake();

  void drop(Client& client);
  void name_party(Client& client, std::string party);
  bool account(Client& client);
  bool add_held(const Client& client, std::size_t more, std::size_t less);
  void rearm(const Client& client, std::uint32_t events) const {
    watch(client.socket, client.id, events | EPOLLONESHOT, EPOLL_CTL_MOD);
  }
  void watch(int descriptor, std::uint64_t name, std::uint32_t events, int operation) const {
    epoll_event event{};
    event.events = events;
    event.data.u64 = name;
    ::epoll_ctl(epoll_.get(), operation, descriptor, &event);
  }
  [[nodiscard]] ClientPointer find(std::uint64_t id) const;

  const ListenerOptions options_;
  Gateway& gateway_;
  Turns turns_;        ///< turns to compute responses
  Turns large_turns_;  ///< turns for large bodies, which are worked on one at a time
  Descriptor epoll_;
  Descriptor listening_;
  PollBell wakes_ready_{true};
  PollBell end_;
  int port_ = 0;
  std::atomic<bool> stopping_ = false;
  std::atomic<Clock::time_point> stopped_at_{Clock::time_point::max()};

  mutable std::mutex table_mutex_;
  std::unordered_map<std::uint64_t, ClientPointer> clients_;
  std::uint64_t next_id_ = kFirstClient;
  std::atomic<int> streams_ = 0;
  std::atomic<std::size_t> buffered_ = 0;
  Shares shares_;

  std::mutex wakes_mutex_;
  std::deque<Wake> wakes_;

  std::thread keeper_;
  std::vector<std::thread> threads_;
};

Status Listener::Server::start() {
  raise_descriptor_limit();
  StatusOr<Descriptor> listening = listen_on(options_.host, options_.port);
  if (!listening.ok()) {
    return listening.status();
  }
  listening_ = std::move(listening).value();
  port_ = port_of(listening_.get());
  for (int i = 0; i < options_.threads + kForLarge + kAttending; ++i) {
    threads_.emplace_back([this] { work(); });
  }
  keeper_ = std::thread([this] { keep(); });
  return {};
}

void Listener::Server::shut_down() {
  stopped_at_ = Clock::now();
  stopping_ = true;
  if (keeper_.joinable()) {
    keeper_.join();
  }
  end_.ring();
  for (std::thread& thread : threads_) {
    thread.join();
  }
  threads_.clear();
  const std::lock_guard guard(table_mutex_);
  clients_.clear();
}

ListenerLoad Listener::Server::load() const {
  const std::lock_guard guard(table_mutex_);
  return {static_cast<int>(clients_.size()), streams_, buffered_};
}

void Listener::Server::work() {
  while (true) {
    epoll_event event{};
    if (::epoll_wait(epoll_.get(), &event, 1, -1) != 1) {
      continue;
    }
    if (event.data.u64 == kEnd) {
      return;
    }
    if (event.data.u64 == kWakes) {
      take_wake();
    } else if (const ClientPointer client = find(event.data.u64)) {
      const std::lock_guard guard(client->mutex);
      attend(client, event.events);
    }
  }
}

/// Accepts connections and closes late ones; after a stop, continues until all are closed or `drain` is over.
void Listener::Server::keep() {
  Clock::time_point next_sweep = Clock::now() + kSweep;
  while (!stopping_) {
    pollfd readable{listening_.get(), POLLIN, 0};
    if (::poll(&readable, 1, static_cast<int>(kSweep.count())) > 0) {
      accept_all();
    }
    if (Clock::now() >= next_sweep) {
      sweep();
      next_sweep = Clock::now() + kSweep;
    }
  }
  listening_.reset();
  const Clock::time_point deadline = Clock::now() + options_.times.drain;
  while (load().connections > 0 && Clock::now() < deadline) {
    sweep();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void Listener::Server::accept_all() {
  std::string remote;
  int socket = -1;
  while ((socket = accept_from(listening_.get(), remote)) >= 0) {
    Descriptor owned(socket);
    const std::lock_guard guard(table_mutex_);
    if (static_cast<int>(clients_.size()) >= options_.connections) {
      ::send(socket, kTooMany.data(), kTooMany.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      continue;
    }
    const std::uint64_t id = next_id_++;
    auto client = std::make_shared<Client>(socket, id, remote, options_.limits);
    owned.release();  // the Client closes the socket
    client->deadline = Clock::now() + options_.times.idle;
    clients_.emplace(id, client);
    watch(socket, id, EPOLLIN | EPOLLONESHOT, EPOLL_CTL_ADD);
  }
  if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) {
    std::this_thread::sleep_for(kSweep);  // without it poll() returns at once
  }
}

void Listener::Server::sweep() {
  std::vector<ClientPointer> all;
  {
    const std::lock_guard guard(table_mutex_);
    all.reserve(clients_.size());
    for (const auto& [id, client] : clients_) {
      all.push_back(client);
    }
  }
  const Clock::time_point now = Clock::now();
  for (const ClientPointer& client : all) {
    const std::unique_lock lock(client->mutex, std::try_to_lock);
    if (lock.owns_lock()) {  // else a thread uses the client, which is not late
      sweep_one(client, now);
    }
  }
}

void Listener::Server::sweep_one(const ClientPointer& client, Clock::time_point now) {
  const bool going = stopping_ && (client->phase == Phase::idle || client->phase == Phase::streaming);
  if (client->phase == Phase::closed || (!going && now < client->deadline)) {
    return;
  }
  const bool wants_room = client->phase == Phase::sending && client->output.empty();
  if (client->phase == Phase::deferred || wants_room) {
    client->deadline = Clock::time_point::max();
    wake({client->id, client->deferral});
  } else if (client->phase == Phase::streaming && !going) {
    client->outbox->put(": still there\n\n", false);
    pump(client);
  } else {
    drop(*client);
  }
}

void Listener::Server::attend(const ClientPointer& client, std::uint32_t events) {
  switch (client->phase) {
    case Phase::idle:
    case Phase::head:
    case Phase::body:
      return read_and_serve(client);
    case Phase::sending:
      if ((events & (EPOLLHUP | EPOLLERR)) != 0) {
        return drop(*client);
      }
      if (send_on(client)) {
        read_and_serve(client);
      }
      return;
    case Phase::streaming:
      if ((events & (EPOLLRDHUP | EPOLLHUP | EPOLLERR)) != 0) {
        return drop(*client);
      }
      return pump(client);
    case Phase::lingering:
      if (client->discard() == Client::Read::ended) {
        return drop(*client);
      }
      return rearm(*client, EPOLLIN);
    case Phase::in_row:
    case Phase::deferred:
      return drop(*client);  // these phases watch for the end only
    case Phase::closed:
      return;
  }
}

/// Serves the requests that have arrived, then waits for more.
void Listener::Server::read_and_serve(const ClientPointer& client) {
  bool drained = false;
  for (int step = 0; step < kFairSteps; ++step) {
    Received received = client->reader.next();
    if (received.kind == Received::Kind::request) {
      account(*client);
      if (!answer(client, std::move(received))) {
        return;
      }
      drained = drained && client->reader.held() == 0;
      continue;
    }
    if (received.kind == Received::Kind::refused) {
      refuse(client, received.head, true);
      return;
    }
    const bool has_room = note_incomplete(*client, received);
    if (!has_room) {
      refuse(client, received.head, true);
      return;
    }
    if (received.kind == Received::Kind::body_incomplete && client->phase != Phase::body) {
      if (std::optional<Response> refusal = judge_head(*client, received.head)) {
        deliver(client, *std::move(refusal));
        return;
      }
    }
    const Client::Read read = drained ? Client::Read::nothing_now : client->receive();
    if (read == Client::Read::ended) {
      return drop(*client);
    }
    if (read == Client::Read::nothing_now) {
      client->reader.shrink();
      return rearm(*client, EPOLLIN);
    }
    drained = read == Client::Read::drained;
  }
  rearm(*client, EPOLLIN | EPOLLOUT);  // fires at once, after others
}

/// Records an incomplete request. Returns false when there is no memory left for it.
bool Listener::Server::note_incomplete(Client& client, const Received& received) {
  if (received.kind == Received::Kind::head_incomplete && client.phase == Phase::idle &&
      client.reader.held() > 0) {
    client.phase = Phase::head;
    client.deadline = Clock::now() + options_.times.head;
  }
  return account(client) || client.phase == Phase::idle;
}

/// Decides by a complete head whether its body may come: memory for bodies is for those who have access.
std::optional<Response> Listener::Server::judge_head(Client& client, const Head& head) {
  Request request = request_of(head);
  request.remote = client.remote;
  const Caller caller = gateway_.caller_of(request);
  name_party(client, caller.party);
  client.head_only = request.method == "HEAD";
  if (std::optional<Response> refusal = gateway_.refused_by_head(request, caller)) {
    client.close_after = true;
    client.linger_after = true;
    client.reader.release();
    return refusal;
  }
  client.phase = Phase::body;
  client.deadline = Clock::now() + options_.times.body;
  if (head.expects_continue) {
    client.output = "HTTP/1.1 100 Continue\r\n\r\n";
    client.flush();
  }
  return std::nullopt;
}

bool Listener::Server::answer(const ClientPointer& client, Received received) {
  client->close_after = !received.head.keep_alive;
  client->chunked = received.head.takes_chunks;
  Request request = request_of(std::move(received.head));
  request.body = std::move(received.body);
  request.remote = client->remote;
  client->head_only = request.method == "HEAD";
  if (Gateway::answers_at_once(request)) {
    return deliver(client, gateway_.serve(std::move(request)));
  }
  Caller caller = gateway_.caller_of(request);
  name_party(*client, caller.party);
  const std::size_t size = request.body.size();
  const auto kept = std::make_shared<Request>(std::move(request));
  return in_turn(
      client, [this, kept, caller = std::move(caller)] { return gateway_.serve(std::move(*kept), caller); },
      size);
}

/// Computes a response, at once or in the client's turn. Returns whether the client can send the next one.
/// @param bytes memory in use by `work`
bool Listener::Server::in_turn(const ClientPointer& client, std::function<Response()> work,
                               std::size_t bytes) {
  client->work = std::move(work);
  client->work_bytes = bytes;
  account(*client);
  if (turns_for(*client).take(client->id, client->party)) {
    return work_on(client);
  }
  client->phase = Phase::in_row;
  client->deadline = Clock::time_point::max();
  rearm(*client, EPOLLRDHUP);
  return false;
}

/// Computes the response in the client's turn. Returns the value of deliver().
bool Listener::Server::work_on(const ClientPointer& client) {
  const Clock::time_point start = Clock::now();
  const WorkLimit limit([this, &client, start, before = processor_time()] {
    return is_over(*client, start, processor_time() - before);
  });
  Response response = std::exchange(client->work, nullptr)();
  pass_turn(turns_for(*client), client->party);
  client->work_bytes = 0;
  account(*client);
  return deliver(client, std::move(response));
}

/// Whether work for a client has to end: it takes too long, or nobody waits for it any more.
/// @param used processor time of the work
bool Listener::Server::is_over(const Client& client, Clock::time_point start,
                               std::chrono::nanoseconds used) const {
  const Clock::time_point now = Clock::now();
  return used > options_.times.reading || now > start + kBusy * options_.times.reading ||
         (stopping_ && now > stopped_at_.load() + kAbandoned) ||
         (now > start + kAbandoned && client.is_gone());
}

/// Passes the turn of a party to the next waiting client that is still connected.
void Listener::Server::pass_turn(Turns& turns, const std::string& party) {
  std::optional<Turns::Next> next = turns.pass(party);
  while (next && !find(next->who)) {
    next = turns.pass(next->party);
  }
  if (next) {
    wake({next->who, 0, &turns, std::move(next->party)});
  }
}

/// Sends a refusal and closes the connection: bytes after an invalid request have no defined meaning.
bool Listener::Server::refuse(const ClientPointer& client, const Head& head, bool linger) {
  Head refused = head;
  if (!refused.refusal) {
    refused.refusal = Refusal{503, "Too many requests are being sent at this moment."};
  }
  client->close_after = true;
  client->linger_after = linger;
  client->head_only = head.method == "HEAD";
  client->reader.release();
  return deliver(client, gateway_.refuse(refused, client->remote));
}

/// Sends a response. Returns true when it was sent and the connection is ready for another request.
bool Listener::Server::deliver(const ClientPointer& client, Response response) {
  client->close_after = client->close_after || stopping_;
  if (response.deferred) {
    return defer(client, std::move(*response.deferred));
  }
  if (response.stream && !client->head_only) {
    return begin_stream(client, response);
  }
  return begin_body(client, response);
}

/// Sends a response, or refuses a large one when too many bytes are being sent.
bool Listener::Server::begin_body(const ClientPointer& client, const Response& response) {
  const std::size_t waiting = client->output.size();  // size of a "100 Continue"
  client->close_after = client->close_after || (response.rest && !client->chunked);
  client->output += to_bytes(response, client->head_only, !client->close_after, client->chunked);
  client->rest = client->head_only ? nullptr : response.rest;
  const bool large = client->rest || client->output.size() > kSmallResponse;
  if (!account(*client) && large) {
    client->output.resize(waiting);
    client->rest.reset();
    account(*client);
    Head head;
    head.refusal = Refusal{503, "Too many large responses are being sent at this moment."};
    return refuse(client, head, false);
  }
  return send_on(client);
}

bool Listener::Server::defer(const ClientPointer& client, Deferred deferred) {
  client->phase = Phase::deferred;
  client->deadline = Clock::now() + deferred.wait;
  client->work = std::move(deferred.resume);
  deferred.arm([weak = weak_from_this(), wake = Wake{client->id, ++client->deferral}] {
    if (const auto server = weak.lock()) {
      server->wake(wake);
    }
  });
  rearm(*client, EPOLLRDHUP);
  return false;
}

bool Listener::Server::begin_stream(const ClientPointer& client, const Response& response) {
  const bool may = shares_.add_stream(client->party, std::max(1, options_.streams / kPartOfStreams));
  if (!may || ++streams_ > options_.streams) {
    if (may) {
      --streams_;
      shares_.remove_stream(client->party);
    }
    Head head;
    head.refusal = Refusal{503, "There are too many streams of events already."};
    return refuse(client, head, false);
  }
  client->phase = Phase::streaming;
  client->close_after = true;
  client->output += to_bytes(response, false, false);
  client->outbox = std::make_shared<Outbox>();
  client->source = response.stream->open([weak = weak_from_this(), id = client->id, outbox = client->outbox](
                                             const std::string& piece, bool last) {
    const bool taken = outbox->put(piece, last);
    if (const auto server = weak.lock()) {
      server->wake({id});
    }
    return taken;
  });
  pump(client);
  return false;
}

/// Sends the pieces of a stream as far as the client accepts them.
void Listener::Server::pump(const ClientPointer& client) {
  if (client->source) {
    client->source->poll();
  }
  bool last = false;
  Client::Sent sent = Client::Sent::all;
  while (sent == Client::Sent::all && !last) {
    if (client->output.empty()) {
      client->output = client->outbox->take(last);
    }
    if (client->output.empty()) {
      break;
    }
    sent = client->flush();
  }
  account(*client);
  if (sent == Client::Sent::failed || client->outbox->closed() || (sent == Client::Sent::all && last)) {
    return drop(*client);
  }
  client->deadline = Clock::now() + options_.times.ping;
  rearm(*client, EPOLLRDHUP | (sent == Client::Sent::some ? EPOLLOUT : 0U));
}

/// Continues to send. Returns true when the response was sent and the connection is ready for a request.
bool Listener::Server::send_on(const ClientPointer& client) {
  for (int piece = 0; piece < kFairSteps; ++piece) {
    const std::size_t before = client->output_sent;
    const Client::Sent sent = client->flush();
    account(*client);
    if (sent == Client::Sent::failed) {
      drop(*client);
      return false;
    }
    if (sent == Client::Sent::some) {  // the deadline restarts when the client took bytes
      const bool first = client->phase != Phase::sending || piece > 0 || client->output_sent > before;
      return wait_to_send(client, EPOLLOUT, first ? Clock::now() + options_.times.send : client->deadline);
    }
    if (!client->rest) {
      return after_response(client);
    }
    // memory for a piece is reserved before it is made, so that threads do not all find the same free memory
    const bool has_room = add_held(*client, kPieceBytes, 0);
    const bool whole = !has_room || append_piece(client);
    add_held(*client, 0, kPieceBytes);
    if (!has_room) {  // waits until other clients have read
      return wait_to_send(client, 0, Clock::now() + kSweep);
    }
    if (!whole) {
      drop(*client);
      return false;
    }
  }
  return wait_to_send(client, EPOLLOUT, Clock::now() + options_.times.send);  // lets other clients continue
}

bool Listener::Server::wait_to_send(const ClientPointer& client, std::uint32_t events,
                                    Clock::time_point deadline) {
  client->phase = Phase::sending;
  client->deadline = deadline;
  rearm(*client, events);
  return false;
}

/// Appends a piece of the body. Returns false when the body cannot be completed.
bool Listener::Server::append_piece(const ClientPointer& client) {
  std::string piece;
  const StatusOr<bool> more = client->rest->append_next(piece);
  if (!more.ok()) {
    return false;
  }
  if (client->chunked) {
    append_chunk(client->output, piece, !*more);
  } else {
    client->output += piece;
  }
  if (!*more) {
    client->rest.reset();
  }
  return true;
}

bool Listener::Server::after_response(const ClientPointer& client) {
  if (client->linger_after) {
    client->end_output();
    client->phase = Phase::lingering;
    client->deadline = Clock::now() + kLinger;
    rearm(*client, EPOLLIN);
    return false;
  }
  if (client->close_after) {
    drop(*client);
    return false;
  }
  client->phase = Phase::idle;
  client->deadline = Clock::now() + options_.times.idle;
  return true;
}

void Listener::Server::wake(const Wake& wake) {
  {
    const std::lock_guard guard(wakes_mutex_);
    wakes_.push_back(wake);
  }
  wakes_ready_.ring();
}

void Listener::Server::take_wake() {
  wakes_ready_.silence();
  Wake wake;
  {
    const std::lock_guard guard(wakes_mutex_);
    if (wakes_.empty()) {
      return;
    }
    wake = wakes_.front();
    wakes_.pop_front();
  }
  woken(wake);
}

void Listener::Server::woken(const Wake& wake) {
  const ClientPointer client = find(wake.client);
  if (!client) {
    return wake.turns == nullptr ? void() : pass_turn(*wake.turns, wake.party);
  }
  const std::lock_guard guard(client->mutex);
  if (wake.turns != nullptr) {
    if (client->phase != Phase::in_row) {  // the client left in the meantime
      return pass_turn(*wake.turns, wake.party);
    }
    if (work_on(client)) {
      read_and_serve(client);
    }
    return;
  }
  if (client->phase == Phase::streaming) {
    return pump(client);
  }
  if (client->phase == Phase::sending && client->output.empty()) {
    if (send_on(client)) {
      read_and_serve(client);
    }
    return;
  }
  if (client->phase == Phase::deferred && client->deferral == wake.deferral &&
      in_turn(client, std::exchange(client->work, nullptr), 0)) {
    read_and_serve(client);
  }
}

/// Gives what a client holds to another party.
void Listener::Server::name_party(Client& client, std::string party) {
  if (party != client.party) {
    shares_.add_bytes(client.party, 0, client.counted);
    shares_.add_bytes(party, client.counted, 0);
    client.party = std::move(party);
  }
}

/// Updates the counted memory of a client. Returns whether all clients, and its party, are within their
/// bounds.
bool Listener::Server::account(Client& client) {
  const std::size_t held = client.held_bytes();
  return add_held(client, held, std::exchange(client.counted, held));
}

/// Adds bytes that a client holds, or takes them away; returns as account().
bool Listener::Server::add_held(const Client& client, std::size_t more, std::size_t less) {
  const std::size_t most = options_.limits.buffered_bytes;
  const std::size_t of_party =
      std::max(most / kPartOfMemory, options_.limits.head_bytes + options_.limits.body_bytes);
  const bool all_within = buffered_.fetch_add(more - less) <= most;
  return shares_.add_bytes(client.party, more, less) <= of_party && all_within;
}

void Listener::Server::drop(Client& client) {
  if (client.phase == Phase::streaming) {
    --streams_;
    shares_.remove_stream(client.party);
    client.outbox->close();
  }
  client.source.reset();
  client.rest.reset();
  client.work = nullptr;
  client.work_bytes = 0;
  add_held(client, 0, std::exchange(client.counted, 0));
  client.close();
  const std::lock_guard guard(table_mutex_);
  clients_.erase(client.id);
}

ClientPointer Listener::Server::find(std::uint64_t id) const {
  const std::lock_guard guard(table_mutex_);
  const auto found = clients_.find(id);
  return found == clients_.end() ? nullptr : found->second;
}

Listener::Listener(ListenerOptions options, Gateway& gateway)
    : server_(std::make_shared<Server>(std::move(options), gateway)) {}

Listener::~Listener() { stop(); }

Status Listener::start() { return server_->start(); }

int Listener::port() const { return server_->port(); }

ListenerLoad Listener::load() const { return server_->load(); }

void Listener::stop() { server_->shut_down(); }

}  // namespace snapthrough::server::http
