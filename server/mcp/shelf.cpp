#include "server/mcp/shelf.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace snapthrough::server::mcp {

const Kept& Shelf::add(std::string_view kind, std::shared_ptr<const nlohmann::json> document,
                       std::shared_ptr<const nlohmann::json> request, std::size_t bytes) {
  std::string id = std::string(kind) + "-" + std::to_string(++made_);
  places_.push_back({{std::move(id), std::move(document), std::move(request)}, bytes});
  bytes_ += bytes;
  while (places_.size() > 1 && (places_.size() > kMost || bytes_ > kMostBytes)) {
    bytes_ -= places_.front().bytes;
    places_.pop_front();
  }
  return places_.back().kept;
}

const Kept* Shelf::find(std::string_view id) const {
  const auto place =
      std::find_if(places_.begin(), places_.end(), [&](const Place& one) { return one.kept.id == id; });
  return place == places_.end() ? nullptr : &place->kept;
}

std::vector<std::string> Shelf::ids() const {
  std::vector<std::string> all;
  for (const Place& place : places_) {
    all.push_back(place.kept.id);
  }
  return all;
}

}  // namespace snapthrough::server::mcp
