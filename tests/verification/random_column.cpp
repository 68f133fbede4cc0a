#include "tests/verification/random_column.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "tests/stress/random_numbers.h"

namespace snapthrough::testing {
namespace {

constexpr double kPi = std::numbers::pi;

class RandomColumn {
 public:
  explicit RandomColumn(std::uint64_t seed) : random_(seed) {}
  Model model();

 private:
  void add_members();
  void add_ends();
  void add_springs();
  void add_bases();
  void add_loads();
  Location place() {
    if (random_.chance(0.3)) return {"n" + std::to_string(random_.below(members_ + 1)), "", 0.0};
    constexpr double kPlaces[] = {0.0, 1.0, 0.5, 0.25};
    const double fraction = random_.chance(0.5) ? random_.unit() : kPlaces[random_.below(4)];
    return {"", "m" + std::to_string(random_.below(members_)), fraction};
  }

  Random random_;
  Model model_;
  int members_ = 1;
  std::array<double, 2> along_{};
  double length_ = 1.0;
  double force_ = 1.0;  ///< pi^2 EI / L^2
};

void RandomColumn::add_members() {
  members_ = 1 + random_.below(4);
  const double angle = random_.chance(0.3) ? 0.5 * kPi * random_.below(4) : random_.between(-kPi, kPi);
  along_ = {std::cos(angle), std::sin(angle)};
  const double scale = random_.decades(-3.0, 3.0);
  const double EI = random_.decades(-3.0, 6.0);
  length_ = 0.0;
  for (int i = 0; i <= members_; ++i) {
    model_.nodes.push_back({"n" + std::to_string(i), along_[0] * length_, along_[1] * length_});
    if (i < members_) length_ += scale * random_.between(0.2, 1.0);
  }
  for (int i = 0; i < members_; ++i) {
    const std::string number = std::to_string(i);
    const double stiffness = EI * random_.decades(-1.5, 1.5);
    model_.sections.push_back(
        {"s" + number, stiffness / (scale * scale) * random_.decades(2.0, 8.0), stiffness, {}});
    Member member{"m" + number, "n" + number, "n" + std::to_string(i + 1), "s" + number, LineCurve{},
                  false,        false};
    if (random_.chance(0.4)) std::swap(member.start, member.end);
    member.release_start_rotation = random_.chance(0.1);
    member.release_end_rotation = random_.chance(0.1);
    model_.members.push_back(member);
  }
  force_ = kPi * kPi * EI / (length_ * length_);
}

void RandomColumn::add_ends() {
  // the first node is held along the line, and sometimes another one
  const double turn = std::atan2(along_[1], along_[0]) * 180.0 / kPi;
  for (int i = 0; i <= members_; ++i) {
    const bool end = i == 0 || i == members_;
    Support support{"n" + std::to_string(i),
                    i == 0 || random_.chance(0.1),
                    random_.chance(end ? 0.8 : 0.2),
                    random_.chance(end ? 0.4 : 0.05),
                    turn,
                    {}};
    if (support.x && random_.chance(0.1))
      support.displacement = PrescribedDisplacement{1e-3 * length_, 0.0, 0.0, Pattern::proportional};
    if (support.x || support.y || support.rotation) model_.supports.push_back(support);
  }
}

void RandomColumn::add_springs() {
  for (int i = random_.below(4); i > 0; --i) {
    Spring spring;
    spring.id = "k" + std::to_string(i);
    spring.at = place();
    if (random_.chance(0.7)) {
      const double sign = random_.chance(0.5) ? 1.0 : -1.0;
      spring.direction = {-sign * along_[1], sign * along_[0]};
    }
    const double size = spring.direction ? 1.0 / length_ : length_;
    spring.stiffness = random_.chance(0.1) ? 0.0 : force_ * size * random_.decades(-4.0, 8.0);
    model_.springs.push_back(spring);
  }
}

void RandomColumn::add_bases() {
  for (int i = random_.below(3); i > 0; --i) {
    Foundation base;
    base.id = "b" + std::to_string(i);
    base.member = "m" + std::to_string(random_.below(members_));
    base.stiffness = random_.chance(0.1) ? 0.0 : force_ / (length_ * length_) * random_.decades(-6.0, 6.0);
    if (random_.chance(0.4)) base.shear_stiffness = force_ * random_.decades(-4.0, 2.0);
    if (random_.chance(0.5)) {
      const double a = random_.unit();
      const double b = random_.unit();
      base.range = {std::min(a, b), std::max(a, b)};
    }
    base.side = random_.chance(0.5) ? Side::left : Side::right;
    model_.foundations.push_back(base);
  }
}

void RandomColumn::add_loads() {
  const auto push = [&](const Location& at, double size, Pattern pattern) {
    model_.loads.push_back(PointLoad{at, {-size * along_[0], -size * along_[1]}, 0.0, pattern});
  };
  push({"n" + std::to_string(members_), "", 0.0}, force_, Pattern::proportional);
  if (random_.chance(0.3)) push(place(), force_ * random_.between(-1.0, 2.0), Pattern::proportional);
  if (random_.chance(0.3)) push(place(), force_ * random_.between(-0.5, 0.3), Pattern::constant);
  if (random_.chance(0.1)) model_.loads.push_back(InitialStrain{"m0", 1e-3, 0.0, Pattern::proportional});
}

Model RandomColumn::model() {
  add_members();
  add_ends();
  add_springs();
  add_bases();
  add_loads();
  return model_;
}

}  // namespace

Model random_column(std::uint64_t seed) { return RandomColumn(seed).model(); }

}  // namespace snapthrough::testing
