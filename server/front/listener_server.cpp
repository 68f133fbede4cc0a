#include "server/front/listener_server.h"

#include <poll.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <system_error>
#include <utility>

#include "server/front/sockets.h"
#include "server/priority.h"

namespace snapthrough::server::http {
namespace {

constexpr std::uint64_t kWakes = 0;  ///< epoll data; clients are numbered from kFirstClient
constexpr std::uint64_t kEnd = 1;
/// Threads in addition to those that compute responses, so that immediate answers do not wait for them.
constexpr int kAttending = 2;
/// Number of threads for the one turn of large bodies, in addition to the others.
constexpr int kForLarge = 1;
/// One party has at most a part of what all share: half of the memory that the others leave, so that some is
/// left however many take their part, and a quarter of the turns.
constexpr std::size_t kPartOfMemory = 2;
constexpr int kPartOfTurns = 4;
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

/// Whether the calling thread is one of Lane low_, and has its priority.
thread_local bool is_low = false;

void watch(const Lane& lane, int descriptor, std::uint64_t name, std::uint32_t events, int operation) {
  epoll_event event{};
  event.events = events;
  event.data.u64 = name;
  ::epoll_ctl(lane.epoll.get(), operation, descriptor, &event);
}

/// Sent when there is no memory to make any other response.
constexpr std::string_view kNoMemory =
    "HTTP/1.1 503 Service Unavailable\r\nRetry-After: 5\r\nContent-Type: application/problem+json\r\n"
    "Content-Length: 131\r\nConnection: close\r\n\r\n"
    R"({"type":"urn:snapthrough:problem:overloaded","title":"Overloaded","status":503,)"
    R"("detail":"There is no memory for this request now."})";

/// A comment of an event stream.
constexpr const char* kStillThere = ": still there\n\n";

}  // namespace

ListenerServer::ListenerServer(ListenerOptions options, Gateway& gateway)
    : options_(std::move(options)),
      gateway_(gateway),
      normal_(options_.threads, std::max(1, options_.threads / kPartOfTurns)),
      low_(options_.threads, std::max(1, options_.threads / kPartOfTurns)),
      large_turns_(1, 1) {
  for (const Lane* lane : {&normal_, &low_}) {
    watch(*lane, lane->wakes_ready.descriptor(), kWakes, EPOLLIN, EPOLL_CTL_ADD);
    watch(*lane, end_.descriptor(), kEnd, EPOLLIN, EPOLL_CTL_ADD);
  }
}

Status ListenerServer::start() {
  raise_descriptor_limit();
  StatusOr<Descriptor> listening = listen_on(options_.host, options_.port);
  if (!listening.ok()) {
    return listening.status();
  }
  listening_ = std::move(listening).value();
  port_ = port_of(listening_.get());
  for (int i = 0; i < options_.threads + kForLarge + kAttending; ++i) {
    threads_.emplace_back([this] { work(normal_); });
  }
  for (int i = 0; i < options_.threads; ++i) {
    threads_.emplace_back([this] {
      is_low = true;
      give_way_from_now_on();
      work(low_);
    });
  }
  keeper_ = std::thread([this] { keep(); });
  return {};
}

void ListenerServer::shut_down() {
  stopped_at_ = Clock::now();
  draining_ = true;
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

ListenerLoad ListenerServer::load() const {
  const std::lock_guard guard(table_mutex_);
  return {static_cast<int>(clients_.size()), streams_, buffered_, normal_.turns.longest_wait(),
          without_memory_};
}

void ListenerServer::work(Lane& lane) {
  while (true) {
    epoll_event event{};
    if (::epoll_wait(lane.epoll.get(), &event, 1, -1) != 1) {
      continue;
    }
    if (event.data.u64 == kEnd) {
      return;
    }
    if (event.data.u64 == kWakes) {
      take_wake(lane);
    } else if (const ClientPointer client = find(event.data.u64)) {
      this->event(client, event.events);
    }
  }
}

/// Handles an event of a connection. An event while another thread computes the response is left to that
/// thread, which watches the connection anew when it has the response: waiting for it would hold two threads.
void ListenerServer::event(const ClientPointer& client, std::uint32_t events) {
  std::unique_lock lock(client->mutex, std::try_to_lock);
  if (!lock.owns_lock()) {
    if (client->working) {
      return;
    }
    lock.lock();
  }
  counted(client, [&] { attend(client, events); });
}

/// Does something for a client, and counts the processor time of that as used by its party.
template <class Use>
void ListenerServer::counted(const ClientPointer& client, const Use& use) {
  with_memory(client, [&] {
    const std::chrono::nanoseconds before = processor_time();
    use();
    use_.add(client->party, processor_time() - before);
  });
}

/// Does something for a client. Ends the connection when that throws, most likely for want of memory.
template <class Use>
void ListenerServer::with_memory(const ClientPointer& client, const Use& use) {
  try {
    use();
  } catch (const std::exception&) {
    ++without_memory_;
    give_up(client);
  }
}

/// Ends a connection that there is no memory for: with 503 unless a part of a response was sent.
void ListenerServer::give_up(const ClientPointer& client) {
  if (client->phase == Phase::closed || client->phase == Phase::sending ||
      client->phase == Phase::streaming || client->output_sent > 0) {
    return drop(*client);
  }
  client->reader.release();
  client->work = nullptr;
  client->rest.reset();
  std::string().swap(client->output);
  ::send(client->socket, kNoMemory.data(), kNoMemory.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  linger(client);
}

/// Accepts connections and closes late ones; after a stop, continues until all are closed or `drain` is over.
void ListenerServer::keep() {
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
  accept_all();  // connections that the kernel has made would be reset with what they have sent
  listening_.reset();
  const Clock::time_point deadline = Clock::now() + options_.times.drain;
  while (load().connections > 0 && Clock::now() < deadline) {
    sweep();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void ListenerServer::accept_all() {
  std::string remote;
  int socket = -1;
  while ((socket = accept_from(listening_.get(), remote)) >= 0) {
    Descriptor owned(socket);
    try {
      admit(std::move(owned), remote);
    } catch (const std::bad_alloc&) {
      ++without_memory_;  // the connection was closed
    }
  }
  if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) {
    std::this_thread::sleep_for(kSweep);  // without it poll() returns at once
  }
}

void ListenerServer::admit(Descriptor socket, const std::string& remote) {
  const std::lock_guard guard(table_mutex_);
  if (static_cast<int>(clients_.size()) >= options_.connections) {
    ::send(socket.get(), kTooMany.data(), kTooMany.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    return;
  }
  const std::uint64_t id = next_id_++;
  const auto client = std::make_shared<Client>(socket.get(), id, remote, options_.limits);
  socket.release();  // the Client closes it
  client->deadline = Clock::now() + options_.times.idle;
  clients_.emplace(id, client);
  watch(normal_, client->socket, id, EPOLLIN | EPOLLONESHOT, EPOLL_CTL_ADD);
}

void ListenerServer::sweep() {
  std::vector<ClientPointer> all;
  until_memory([&] {
    const std::lock_guard guard(table_mutex_);
    all.reserve(clients_.size());
    for (const auto& [id, client] : clients_) {
      all.push_back(client);
    }
  });
  const Clock::time_point now = Clock::now();
  for (const ClientPointer& client : all) {
    const std::unique_lock lock(client->mutex, std::try_to_lock);
    if (lock.owns_lock()) {  // else a thread uses the client, which is not late
      with_memory(client, [&] { sweep_one(client, now); });
    }
  }
}

void ListenerServer::sweep_one(const ClientPointer& client, Clock::time_point now) {
  const bool going = stopping_ && client->phase == Phase::streaming;
  if (client->phase == Phase::idle) {
    return end_idle(client, now);
  }
  if (client->phase == Phase::closed || (!going && now < client->deadline)) {
    return;
  }
  const bool wants_room = client->phase == Phase::sending && client->output.empty();
  if (client->phase == Phase::deferred || wants_room) {
    client->deadline = Clock::time_point::max();
    wake(normal_, {client->id, client->deferral});
  } else if (client->phase == Phase::streaming && !going) {
    client->outbox->put(kStillThere, false);
    pump(client);
  } else {
    drop(*client);
  }
}

/// Ends a connection that waits for a request too long, or at a stop, unless a request has arrived. At a stop
/// a connection that was opened or answered less than `settle` ago stays open: its request may be under way.
void ListenerServer::end_idle(const ClientPointer& client, Clock::time_point now) {
  const Clock::time_point idle_since = client->deadline - options_.times.idle;
  const Clock::time_point end = stopping_ ? idle_since + options_.times.settle : client->deadline;
  if (now >= end && !client->has_arrived()) {
    linger(client);
  }
}

void ListenerServer::attend(const ClientPointer& client, std::uint32_t events) {
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
      if ((events & (EPOLLHUP | EPOLLERR)) != 0) {
        return drop(*client);
      }
      if ((events & EPOLLRDHUP) != 0) {  // a client that has closed, and not only ended its side, resets now
        client->asked = true;
        client->outbox->put(kStillThere, false);
      }
      return pump(client);
    case Phase::lingering:
      if (client->discard() == Client::Read::ended) {
        return drop(*client);
      }
      return rearm(*client, EPOLLIN);
    case Phase::in_row:
    case Phase::deferred:
      if ((events & (EPOLLHUP | EPOLLERR)) != 0) {
        return drop(*client);
      }
      client->ask_whether_it_waits();
      client->asked = true;  // also a client that cannot be asked is watched for a reset only
      return rearm(*client, 0);
    case Phase::closed:
      return;
  }
}

/// Serves the requests that have arrived, then waits for more.
void ListenerServer::read_and_serve(const ClientPointer& client) {
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
bool ListenerServer::note_incomplete(Client& client, const Received& received) {
  if (received.kind == Received::Kind::head_incomplete && client.phase == Phase::idle &&
      client.reader.held() > 0) {
    client.phase = Phase::head;
    client.deadline = Clock::now() + options_.times.head;
  }
  return account(client) || client.phase == Phase::idle;
}

/// Decides by a complete head whether its body may come: memory for bodies is for those who have access.
std::optional<Response> ListenerServer::judge_head(Client& client, const Head& head) {
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
    client.output = kContinue;
    client.flush();
  }
  return std::nullopt;
}

bool ListenerServer::answer(const ClientPointer& client, Received received) {
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
bool ListenerServer::in_turn(const ClientPointer& client, std::function<Response()> work, std::size_t bytes) {
  client->work = std::move(work);
  client->work_bytes = bytes;
  account(*client);
  Turns& turns = turns_for(*client);
  const bool has_turn = turns.take(client->id, client->party);
  const bool elsewhere = &turns == &low_.turns && !is_low;
  if (has_turn && !elsewhere) {
    return work_on(client, turns);
  }
  client->phase = Phase::in_row;
  client->deadline = Clock::time_point::max();
  rearm(*client, end_of(*client));
  if (has_turn) {
    wake(low_, {client->id, 0, &turns, client->party});
  }
  return false;
}

/// Whether threads of low priority serve a client: its party has used much processor time. Large bodies keep
/// the normal priority, since others wait for their only turn.
bool ListenerServer::gives_way(const Client& client) const {
  return client.work_bytes <= LargeDocument::kSmall && use_.is_much(client.party);
}

Turns& ListenerServer::turns_for(const Client& client) {
  return client.work_bytes > LargeDocument::kSmall ? large_turns_
         : gives_way(client)                       ? low_.turns
                                                   : normal_.turns;
}

/// Watches the socket of a client for events, once, in the lane that serves the client.
void ListenerServer::rearm(Client& client, std::uint32_t events) {
  const bool low = gives_way(client);
  if (low != client.gives_way) {
    watch(low ? normal_ : low_, client.socket, client.id, 0, EPOLL_CTL_DEL);
  }
  watch(low ? low_ : normal_, client.socket, client.id, events | EPOLLONESHOT,
        low == client.gives_way ? EPOLL_CTL_MOD : EPOLL_CTL_ADD);
  client.gives_way = low;
}

/// Computes the response in the client's turn. Returns the value of deliver().
bool ListenerServer::work_on(const ClientPointer& client, Turns& turns) {
  Response response = in_its_turn(*client, turns);
  client->work_bytes = 0;
  account(*client);
  return deliver(client, std::move(response));
}

/// Computes the response of a client that has a turn, and passes the turn on, also when that throws.
Response ListenerServer::in_its_turn(Client& client, Turns& turns) {
  struct Turn {
    Turn(ListenerServer& the_server, Client& its_client, Turns& taken)
        : server(the_server), client(its_client), turns(taken) {
      client.working = true;
    }
    ~Turn() {
      client.working = false;
      server.pass_turn(turns, client.party);
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    Turn(Turn&&) = delete;
    Turn& operator=(Turn&&) = delete;
    ListenerServer& server;
    Client& client;
    Turns& turns;
  };
  const Turn turn(*this, client, turns);
  const Clock::time_point start = Clock::now();
  const WorkLimit limit([this, &client, start, before = processor_time()] {
    return is_over(client, start, processor_time() - before);
  });
  return std::exchange(client.work, nullptr)();
}

/// Returns why work for a client has to end: it takes too long, nobody waits for it any more, or the service
/// stops; nullopt while it may go on. @param used processor time of the work
std::optional<WorkEnd> ListenerServer::is_over(Client& client, Clock::time_point start,
                                               std::chrono::nanoseconds used) const {
  const Clock::time_point now = Clock::now();
  if (used > options_.times.reading || now > start + kBusy * options_.times.reading) {
    return WorkEnd::time_used;
  }
  if (stopping_ && now > stopped_at_.load() + kAbandoned) {
    return WorkEnd::stopping;
  }
  return now > start + kAbandoned && client.is_gone() ? std::optional(WorkEnd::abandoned) : std::nullopt;
}

/// Passes the turn of a party to the next waiting client that is still connected.
void ListenerServer::pass_turn(Turns& turns, const std::string& party) noexcept {
  std::optional<Turns::Next> next = until_memory([&] { return turns.pass(party); });
  while (next && !find(next->who)) {
    next = until_memory([&] { return turns.pass(next->party); });
  }
  if (next) {
    wake(&turns == &low_.turns ? low_ : normal_, {next->who, 0, &turns, std::move(next->party)});
  }
}

/// Sends a refusal and closes the connection: bytes after an invalid request have no defined meaning.
bool ListenerServer::refuse(const ClientPointer& client, const Head& head, bool linger) {
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

void ListenerServer::wake(Lane& lane, const Wake& wake) noexcept {
  until_memory([&] {
    const std::lock_guard guard(lane.mutex);
    lane.wakes.push_back(wake);
  });
  lane.wakes_ready.ring();
}

void ListenerServer::take_wake(Lane& lane) {
  lane.wakes_ready.silence();
  Wake wake;
  {
    const std::lock_guard guard(lane.mutex);
    if (lane.wakes.empty()) {
      return;
    }
    wake = std::move(lane.wakes.front());
    lane.wakes.pop_front();
  }
  woken(wake);
}

void ListenerServer::woken(const Wake& wake) {
  const ClientPointer client = find(wake.client);
  if (!client) {
    return wake.turns == nullptr ? void() : pass_turn(*wake.turns, wake.party);
  }
  const std::lock_guard guard(client->mutex);
  if (wake.turns != nullptr && client->phase != Phase::in_row) {  // the client left in the meantime
    return pass_turn(*wake.turns, wake.party);
  }
  if (wake.turns == nullptr && !is_low && gives_way(*client)) {
    return this->wake(low_, wake);
  }
  counted(client, [&] { resume(client, wake); });
}

/// Continues with a client that waited for its turn or for an event.
void ListenerServer::resume(const ClientPointer& client, const Wake& wake) {
  if (wake.turns != nullptr) {
    if (work_on(client, *wake.turns)) {
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

/// Gives what a client holds to another party. When that throws, all parties have what they had.
void ListenerServer::name_party(Client& client, std::string party) {
  if (party != client.party) {
    shares_.add_bytes(party, client.counted, 0);
    client.party.swap(party);
    shares_.add_bytes(party, 0, client.counted);
  }
}

/// Updates the counted memory of a client. Returns whether all clients, and its party, are within their
/// bounds.
bool ListenerServer::account(Client& client) {
  const std::size_t held = client.held_bytes();
  const bool within = add_held(client, held, client.counted);
  client.counted = held;
  return within;
}

/// Adds bytes that a client holds, or takes them away; returns as account().
bool ListenerServer::add_held(const Client& client, std::size_t more, std::size_t less) {
  const std::size_t most = options_.limits.buffered_bytes;
  const std::size_t of_party = shares_.add_bytes(client.party, more, less);
  const std::size_t before = buffered_.fetch_add(more - less);
  const std::size_t of_all = before + more - less;
  const std::size_t of_others = std::min(of_all - std::min(of_all, of_party), most);
  const std::size_t one_body = options_.limits.head_bytes + options_.limits.body_bytes;
  const std::size_t part = std::max((most - of_others) / kPartOfMemory, of_others <= most / 2 ? one_body : 0);
  return before <= most && of_party <= part;
}

void ListenerServer::drop(Client& client) {
  if (client.phase == Phase::streaming) {
    --streams_;
    shares_.remove_stream(client.party);
    if (client.outbox) {
      client.outbox->close();
    }
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

ClientPointer ListenerServer::find(std::uint64_t id) const {
  const std::lock_guard guard(table_mutex_);
  const auto found = clients_.find(id);
  return found == clients_.end() ? nullptr : found->second;
}

}  // namespace snapthrough::server::http
