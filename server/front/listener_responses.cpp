#include <sys/epoll.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <new>
#include <utility>

#include "server/front/listener_server.h"
#include "server/front/response_bytes.h"

namespace snapthrough::server::http {
namespace {

/// Responses below this size in bytes are always sent.
constexpr std::size_t kSmallResponse = 64 * 1024;
/// One party has a quarter of the streams at most.
constexpr int kPartOfStreams = 4;
constexpr std::chrono::milliseconds kLinger{500};

}  // namespace

/// Sends a response. Returns true when it was sent and the connection is ready for another request.
bool ListenerServer::deliver(const ClientPointer& client, Response response) {
  // a client that does not expect the close may have sent another request
  client->linger_after = client->linger_after || (draining_ && !client->close_after);
  client->close_after = client->close_after || draining_;
  if (response.deferred) {
    return defer(client, std::move(*response.deferred));
  }
  if (response.stream && !client->head_only) {
    return begin_stream(client, response);
  }
  return begin_body(client, response);
}

/// Sends a response, or refuses a large one when too many bytes are being sent.
bool ListenerServer::begin_body(const ClientPointer& client, const Response& response) {
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
  client->phase = Phase::sending;
  client->deadline = Clock::now() + options_.times.send;
  return send_on(client);
}

bool ListenerServer::defer(const ClientPointer& client, Deferred deferred) {
  client->phase = Phase::deferred;
  client->deadline = Clock::now() + deferred.wait;
  client->work = std::move(deferred.resume);
  deferred.arm([weak = weak_from_this(), wake = Wake{client->id, ++client->deferral}] {
    if (const auto server = weak.lock()) {
      ListenerServer::wake(server->normal_, wake);
    }
  });
  rearm(*client, end_of(*client));
  return false;
}

bool ListenerServer::begin_stream(const ClientPointer& client, const Response& response) {
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
      ListenerServer::wake(server->normal_, {id});
    }
    return taken;
  });
  pump(client);
  return false;
}

/// Sends the pieces of a stream as far as the client accepts them.
void ListenerServer::pump(const ClientPointer& client) {
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
  rearm(*client, end_of(*client) | (sent == Client::Sent::some ? EPOLLOUT : 0U));
}

/// Continues to send. Returns true when the response was sent and the connection is ready for a request.
bool ListenerServer::send_on(const ClientPointer& client) {
  for (int piece = 0; piece < kFairSteps; ++piece) {
    const std::size_t before = client->output_sent;
    const Client::Sent sent = client->flush();
    account(*client);
    if (sent == Client::Sent::failed) {
      drop(*client);
      return false;
    }
    if (sent == Client::Sent::some) {  // the deadline restarts when the client took bytes
      const bool taken = piece > 0 || client->output_sent > before;
      return wait_to_send(client, EPOLLOUT, taken ? Clock::now() + options_.times.send : client->deadline);
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

bool ListenerServer::wait_to_send(const ClientPointer& client, std::uint32_t events,
                                  Clock::time_point deadline) {
  client->phase = Phase::sending;
  client->deadline = deadline;
  rearm(*client, events);
  return false;
}

/// Appends a piece of the body. Returns false when the body cannot be completed.
bool ListenerServer::append_piece(const ClientPointer& client) {
  try {
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
  } catch (const std::bad_alloc&) {
    ++without_memory_;
    return false;
  }
}

bool ListenerServer::after_response(const ClientPointer& client) {
  if (client->linger_after) {
    linger(client);
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

/// Ends the sending side, and discards what the client sends until it closes: a close() with unread bytes
/// would reset the connection, which can destroy a response that the client has not read yet (RFC 9112, 9.6).
void ListenerServer::linger(const ClientPointer& client) {
  client->end_output();
  client->phase = Phase::lingering;
  client->deadline = Clock::now() + kLinger;
  rearm(*client, EPOLLIN);
}

}  // namespace snapthrough::server::http
