#include "server/front/request_reader.h"

#include <algorithm>
#include <utility>

namespace snapthrough::server::http {
namespace {

constexpr std::string_view kHeadEnd = "\r\n\r\n";
constexpr std::size_t kKeptCapacity = 4096;

}  // namespace

Received RequestReader::refused(Head head) {
  Received received;
  received.kind = Received::Kind::refused;
  received.head = std::move(head);
  return received;
}

Received RequestReader::next() {
  if (head_size_ == 0) {
    const std::size_t end = buffer_.find(kHeadEnd, searched_);
    const bool found = end != std::string::npos;
    if (found ? end + kHeadEnd.size() > limits_.head_bytes : buffer_.size() > limits_.head_bytes) {
      Head head;
      head.refusal = Refusal{431, "The headers may have " + std::to_string(limits_.head_bytes) + " bytes."};
      return refused(std::move(head));
    }
    if (!found) {
      searched_ = buffer_.size() - std::min(buffer_.size(), kHeadEnd.size() - 1);
      return {};
    }
    head_size_ = end + kHeadEnd.size();
    head_ = read_head(std::string_view(buffer_).substr(0, head_size_), limits_);
    if (head_.refusal) {
      return refused(std::move(head_));
    }
  }
  if (head_.chunked) {
    return next_of_chunks();
  }
  Received received;
  const std::size_t total = head_size_ + head_.body_bytes;
  if (buffer_.size() < total) {
    received.kind = Received::Kind::body_incomplete;
    received.head = head_;
    return received;
  }
  received.kind = Received::Kind::request;
  received.head = std::exchange(head_, {});
  if (buffer_.size() == total) {  // a large body is moved, not copied, and freed while its answer waits
    received.body = std::exchange(buffer_, {});
    received.body.erase(0, head_size_);
  } else {
    received.body = buffer_.substr(head_size_, total - head_size_);
    buffer_.erase(0, total);
  }
  head_size_ = 0;
  searched_ = 0;
  return received;
}

Received RequestReader::next_of_chunks() {
  std::size_t taken = 0;
  if (!chunks_) {
    chunks_.emplace(limits_.body_bytes);
    taken = head_size_;
  }
  taken += chunks_->take(std::string_view(buffer_).substr(taken));
  buffer_.erase(0, taken);
  if (chunks_->refusal()) {
    head_.refusal = chunks_->refusal();
    return refused(std::move(head_));
  }
  Received received;
  if (!chunks_->complete()) {
    received.kind = Received::Kind::body_incomplete;
    received.head = head_;
    return received;
  }
  received.kind = Received::Kind::request;
  received.head = std::exchange(head_, {});
  received.body = chunks_->release();
  chunks_.reset();
  head_size_ = 0;
  searched_ = 0;
  return received;
}

void RequestReader::shrink() {
  if (buffer_.capacity() > std::max(kKeptCapacity, 2 * buffer_.size())) {
    std::string(buffer_).swap(buffer_);
  }
}

}  // namespace snapthrough::server::http
