#include "api/json_pieces.h"

#include <utility>

namespace snapthrough::api {

void JsonPieces::append(std::string_view piece) {
  for (const char c : piece) {
    in_string_ ? take_in_string(c) : take(c);
  }
}

std::optional<std::string> JsonPieces::next() {
  if (complete_.empty()) {
    return std::nullopt;
  }
  std::string value = std::move(complete_.front());
  complete_.pop_front();
  return value;
}

std::size_t JsonPieces::held_bytes() const {
  std::size_t bytes = value_.capacity();
  for (const std::string& value : complete_) {
    bytes += value.capacity();
  }
  return bytes;
}

void JsonPieces::take_in_string(char c) {
  keep(c);
  if (escaped_) {
    escaped_ = false;
  } else if (c == '\\') {
    escaped_ = true;
  } else if (c == '"') {
    in_string_ = false;
  } else if (depth_ == 1 && !wanted_) {
    name_ += c;
  }
}

void JsonPieces::take(char c) {
  switch (c) {
    case '"':
      in_string_ = true;
      if (depth_ == 1 && !wanted_) {
        name_.clear();
      }
      return keep(c);
    case ':':
      if (depth_ != 1) {
        return keep(c);
      }
      wanted_ = name_ == member_;
      return;
    case '{':
    case '[':
      keep(c);
      ++depth_;
      return;
    case '}':
    case ']':
      --depth_;
      if (wanted_ && depth_ < level_) {
        complete();
        wanted_ = false;
      }
      return keep(c);
    case ',':
      if (wanted_ && depth_ == level_) {
        complete();
        wanted_ = level_ > 1;
        return;
      }
      wanted_ = wanted_ && depth_ > 1;
      return keep(c);
    default:
      return keep(c);
  }
}

void JsonPieces::keep(char c) {
  if (inside()) {
    value_ += c;
  }
}

/// Ends a value; white space alone is an empty array, which has no element.
void JsonPieces::complete() {
  if (value_.find_first_not_of(" \t\r\n") != std::string::npos) {
    complete_.push_back(std::move(value_));
  }
  value_ = {};
}

}  // namespace snapthrough::api
