#include "solver/events/least_piece.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace snapthrough {
namespace {

using Eigen::VectorXd;

/// Search of the least piece. Source: docs/decisions/0009, Costs; rounding of modes and loads.
struct PieceLimits {
  /// Displacement into a support, over the mode's largest displacement, that counts as zero.
  static constexpr double no_displacement = 1e-7;
  static constexpr double same_load = 1e-9;  ///< relative difference of two loads of one piece
  static constexpr int most_pieces = 400;    ///< visited pieces in over_springs()
  static constexpr int most_springs = 30;    ///< springs in over_springs(), one bit each
  static constexpr int most_steps = 40;      ///< steps of a descent
  static constexpr int halvings = 8;         ///< step reductions per step of a descent
};

class Search {
 public:
  Search(const StructuralProblem& problem, const PieceSolver& solver, const TouchingMarks& marks,
         FrozenContact& contact)
      : problem_(problem), solver_(solver), marks_(marks), contact_(contact) {}

  [[nodiscard]] LeastPiece over_springs();
  [[nodiscard]] LeastPiece by_descent(const VectorXd& near);

 private:
  /// Piece in the search tree: bit i of `springs` is set when spring i acts. `load` is a lower bound for all
  /// pieces that add springs with index `next` or higher.
  struct Node {
    double load = 0.0;
    unsigned springs = 0;
    std::size_t next = 0;
    bool fits = false;
    // the smallest load is on top of the priority queue
    bool operator<(const Node& other) const { return load > other.load; }
  };

  [[nodiscard]] Node visit(unsigned springs, std::size_t next);
  void set_springs(unsigned springs);
  void set_all(bool acting);
  void set_cone_of(const VectorXd& motion);
  [[nodiscard]] bool fits(const VectorXd& mode, unsigned springs);
  [[nodiscard]] double quotient(const VectorXd& motion);
  /// Minimises the Rayleigh quotient from a motion; updates `least_` when the result is lower.
  void descend(VectorXd motion);

  const StructuralProblem& problem_;
  const PieceSolver& solver_;
  const TouchingMarks& marks_;
  FrozenContact& contact_;
  std::vector<double> displacements_;
  std::vector<char> acting_;
  Piece least_{std::numeric_limits<double>::infinity(), {}};
};

void Search::set_springs(unsigned springs) {
  acting_.resize(problem_.contact().springs(marks_));
  for (std::size_t i = 0; i < acting_.size(); ++i) acting_[i] = (springs >> i) % 2 != 0;
  problem_.contact().set(marks_, VectorXd::Zero(problem_.size()), acting_, contact_);
}

void Search::set_all(bool acting) {
  acting_.assign(problem_.contact().springs(marks_), acting ? 1 : 0);
  problem_.contact().set(marks_, acting ? VectorXd() : VectorXd::Zero(problem_.size()), acting_, contact_);
}

void Search::set_cone_of(const VectorXd& motion) {
  problem_.contact().displacements(marks_, motion, displacements_);
  acting_.resize(displacements_.size());
  for (std::size_t i = 0; i < acting_.size(); ++i) acting_[i] = displacements_[i] > 0.0;
  problem_.contact().set(marks_, motion, acting_, contact_);
}

/// Whether the mode or its opposite moves into all springs that act and away from all others.
bool Search::fits(const VectorXd& mode, unsigned springs) {
  problem_.contact().displacements(marks_, mode, displacements_);
  bool one_way = true;
  bool other_way = true;
  for (std::size_t i = 0; i < displacements_.size(); ++i) {
    const double into = (springs >> i) % 2 != 0 ? displacements_[i] : -displacements_[i];
    one_way = one_way && into >= -PieceLimits::no_displacement;
    other_way = other_way && into <= PieceLimits::no_displacement;
  }
  return one_way || other_way;
}

Search::Node Search::visit(unsigned springs, std::size_t next) {
  set_springs(springs);
  const std::optional<Piece> piece = solver_.lowest();
  if (!piece) return {0.0, springs, next, false};
  return {piece->load, springs, next, fits(piece->mode, springs)};
}

LeastPiece Search::over_springs() {
  const std::size_t count = problem_.contact().springs(marks_);
  std::priority_queue<Node> queue;
  queue.push(visit(0U, 0));
  for (int pieces = 1; !queue.empty();) {
    const Node node = queue.top();
    queue.pop();
    if (node.fits) {
      set_springs(node.springs);
      return {true, true, node.load};
    }
    if (pieces + static_cast<int>(count) > PieceLimits::most_pieces) break;
    for (std::size_t i = node.next; i < count; ++i, ++pieces)
      queue.push(visit(node.springs | (1U << i), i + 1));
  }
  return {};
}

double Search::quotient(const VectorXd& motion) {
  set_cone_of(motion);
  return solver_.quotient(motion);
}

void Search::descend(VectorXd motion) {
  double load = quotient(motion);
  for (int step = 0; step < PieceLimits::most_steps; ++step) {
    set_cone_of(motion);
    std::optional<Piece> piece = solver_.lowest();
    if (!piece || piece->load >= load * (1.0 - PieceLimits::same_load)) break;
    if (motion.dot(problem_.metric().cwiseProduct(piece->mode)) < 0.0) piece->mode = -piece->mode;
    double share = 1.0;
    double lower = load;
    VectorXd trial;
    const auto falls = [&] { return lower > 0.0 && lower < load; };
    for (int i = 0; i < PieceLimits::halvings && !falls(); ++i, share *= 0.5) {
      trial = motion + share * (piece->mode - motion);
      lower = quotient(trial);
    }
    if (!falls()) break;
    motion = trial / trial.lpNorm<Eigen::Infinity>();
    load = lower;
  }
  if (load < least_.load) least_ = {load, std::move(motion)};
}

LeastPiece Search::by_descent(const VectorXd& near) {
  std::vector<VectorXd> starts;
  double above = 0.0;
  for (const bool bilateral : {false, true}) {
    set_all(bilateral);
    const std::optional<Piece> piece = solver_.lowest();
    if (!piece) continue;
    if (!bilateral) above = piece->load;
    starts.push_back(piece->mode);
    starts.push_back(-piece->mode);
  }
  if (near.size() > 0) starts = {near};
  for (const VectorXd& start : starts) {
    descend(start);
    if (least_.load <= above * (1.0 + PieceLimits::same_load)) break;  // no lower load exists
  }
  if (least_.mode.size() == 0) {
    set_all(true);
    return {};
  }
  set_cone_of(least_.mode);
  return {true, least_.load <= above * (1.0 + PieceLimits::same_load), above, least_.mode};
}

}  // namespace

LeastPiece set_least_piece(const StructuralProblem& problem, const PieceSolver& solver,
                           const TouchingMarks& marks, const VectorXd& near, FrozenContact& contact) {
  Search search(problem, solver, marks, contact);
  const bool foundations = std::find(marks.contacts.begin(), marks.contacts.end(), 1) != marks.contacts.end();
  if (!foundations && problem.contact().springs(marks) <= PieceLimits::most_springs)
    if (const LeastPiece least = search.over_springs(); least.found) return least;
  return search.by_descent(near);
}

}  // namespace snapthrough
