#include "server/front/chunked_body.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace snapthrough::server::http {
namespace {

constexpr std::string_view kLineEnd = "\r\n";
constexpr std::size_t kMostDigits = 16;  // digits of a 64-bit chunk size

}  // namespace

std::size_t ChunkedBody::refuse(int status, std::string detail) {
  refusal_ = Refusal{status, std::move(detail)};
  return 0;
}

std::size_t ChunkedBody::take(std::string_view bytes) {
  std::size_t taken = 0;
  while (!refusal_ && !complete()) {
    const std::string_view rest = bytes.substr(taken);
    const State before = state_;
    std::size_t now = 0;
    switch (state_) {
      case State::size:
        now = take_size(rest);
        break;
      case State::data:
        now = take_data(rest);
        break;
      case State::data_end:
        now = take_line_end(rest, State::size);
        break;
      case State::last_end:
        now = take_line_end(rest, State::complete);
        break;
      case State::complete:
        break;
    }
    taken += now;
    if (state_ == before) {  // the rest of the bytes is incomplete
      break;
    }
  }
  return taken;
}

std::size_t ChunkedBody::take_size(std::string_view bytes) {
  const std::size_t digits = std::min(bytes.find_first_not_of("0123456789abcdefABCDEF"), bytes.size());
  const std::string_view end = bytes.substr(digits, kLineEnd.size());
  if (digits > kMostDigits || (digits == 0 && !end.empty()) || end != kLineEnd.substr(0, end.size())) {
    return refuse(400, "The size of a chunk is up to 16 hexadecimal digits, without extensions.");
  }
  if (end.size() < kLineEnd.size()) {
    return 0;
  }
  std::size_t size = 0;
  std::from_chars(bytes.data(), bytes.data() + digits, size, 16);
  if (size > limit_ - body_.size()) {
    return refuse(413, "A request body may have " + std::to_string(limit_) + " bytes.");
  }
  left_ = size;
  state_ = left_ > 0 ? State::data : State::last_end;
  return digits + kLineEnd.size();
}

std::size_t ChunkedBody::take_data(std::string_view bytes) {
  const std::string_view data = bytes.substr(0, left_);
  body_.append(data);
  left_ -= data.size();
  if (left_ == 0) {
    state_ = State::data_end;
  }
  return data.size();
}

std::size_t ChunkedBody::take_line_end(std::string_view bytes, State next) {
  const std::string_view end = bytes.substr(0, kLineEnd.size());
  if (end != kLineEnd.substr(0, end.size())) {
    return refuse(400, next == State::complete
                           ? "A body in chunks ends with an empty line: trailers are not taken."
                           : "A chunk is not as long as its size says.");
  }
  if (end.size() < kLineEnd.size()) {
    return 0;
  }
  state_ = next;
  return kLineEnd.size();
}

}  // namespace snapthrough::server::http
