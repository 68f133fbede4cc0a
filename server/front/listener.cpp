#include "server/front/listener.h"

#include <utility>

#include "server/front/listener_server.h"

namespace snapthrough::server::http {

Listener::Listener(ListenerOptions options, Gateway& gateway)
    : server_(std::make_shared<ListenerServer>(std::move(options), gateway)) {}

Listener::~Listener() { stop(); }

Status Listener::start() { return server_->start(); }

int Listener::port() const { return server_->port(); }

ListenerLoad Listener::load() const { return server_->load(); }

void Listener::begin_drain() { server_->begin_drain(); }

void Listener::stop() { server_->shut_down(); }

}  // namespace snapthrough::server::http
