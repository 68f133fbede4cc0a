#include "api/plot/document.h"

#include <cmath>

#include "api/plot/plot_error.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::plot {
namespace {

constexpr double kLargest = 1e100;
constexpr double kSmallest = 1e-100;

}  // namespace

void Field::fail(const std::string& rule) const { throw PlotError(pointer(), rule); }

void Field::need_object() const {
  if (!value_->is_object()) {
    fail("must be an object");
  }
}

Field Field::at(std::string_view key) const {
  need_object();
  const auto found = value_->find(key);
  if (found == value_->end()) {
    throw PlotError(place_.with(key).text(), "is missing");
  }
  return Field(*found, place_.with(std::string_view(found.key())));
}

std::optional<Field> Field::find(std::string_view key) const {
  need_object();
  const auto found = value_->find(key);
  if (found == value_->end() || found->is_null()) {
    return std::nullopt;
  }
  return Field(*found, place_.with(std::string_view(found.key())));
}

Field Field::item(std::size_t index) const {
  WorkLimit::poll();
  return Field((*value_)[index], place_.with(index));
}

std::size_t Field::size() const {
  if (!value_->is_array()) {
    fail("must be a list");
  }
  return value_->size();
}

std::vector<std::pair<std::string, Field>> Field::members() const {
  need_object();
  std::vector<std::pair<std::string, Field>> all;
  for (auto entry = value_->begin(); entry != value_->end(); ++entry) {
    all.emplace_back(entry.key(), Field(*entry, place_.with(std::string_view(entry.key()))));
  }
  return all;
}

double Field::number() const {
  if (!value_->is_number()) {
    fail("must be a number");
  }
  const double value = value_->get<double>();
  if (!(std::abs(value) <= kLargest)) {
    fail("must be a finite number of at most 1e100 in size");
  }
  return std::abs(value) < kSmallest ? 0 : value;
}

double Field::number_or_none() const { return value_->is_null() ? kNone : number(); }

std::string Field::text() const {
  if (!value_->is_string()) {
    fail("must be a text");
  }
  return value_->get_ref<const std::string&>();
}

bool Field::flag() const {
  if (!value_->is_boolean()) {
    fail("must be true or false");
  }
  return value_->get<bool>();
}

std::size_t Field::index() const {
  const double value = number();
  if (value < 0 || value != std::floor(value) || value > 1e15) {
    fail("must be a whole number, 0 or more");
  }
  return static_cast<std::size_t>(value);
}

std::vector<double> Field::numbers() const {
  std::vector<double> all(size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = item(i).number();
  }
  return all;
}

std::vector<double> Field::numbers_or_none() const {
  std::vector<double> all(size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = item(i).number_or_none();
  }
  return all;
}

std::vector<double> Field::numbers(std::size_t count) const {
  if (size() != count) {
    fail("must have " + std::to_string(count) + " numbers, as the other lists beside it, and has " +
         std::to_string(size()));
  }
  return numbers();
}

std::vector<double> Field::increasing() const {
  std::vector<double> all = numbers();
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i] < all[i - 1]) {
      item(i).fail("must not be less than the number before it");
    }
  }
  return all;
}

double number_or(const Field& object, std::string_view key, double otherwise) {
  const std::optional<Field> found = object.find(key);
  return found ? found->number() : otherwise;
}

std::string text_or(const Field& object, std::string_view key, std::string_view otherwise) {
  const std::optional<Field> found = object.find(key);
  return found ? found->text() : std::string(otherwise);
}

std::array<double, 2> range_or_all(const Field& object) {
  const std::optional<Field> range = object.find("range");
  if (!range) {
    return {0, 1};
  }
  const std::vector<double> ends = range->numbers(2);
  if (!(ends[0] >= 0 && ends[0] < ends[1] && ends[1] <= 1)) {
    range->fail("must be two increasing fractions from 0 to 1");
  }
  return {ends[0], ends[1]};
}

}  // namespace snapthrough::api::plot
