#include "solver/numeric/elimination_plan.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

namespace snapthrough {
namespace {

/// Groups of unknowns that belong to the same blocks and are eliminated together.
struct Groups {
  std::vector<std::vector<int>> unknowns;  ///< one list per group
  std::vector<std::vector<int>> of_block;  ///< groups coupled by each block, without repetition
  std::vector<std::vector<int>> alone;  ///< unknowns that belong to this block only, if the block has others
};

Groups group(int size, std::span<const std::vector<int>> blocks) {
  std::vector<std::vector<int>> holders(static_cast<std::size_t>(size));
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (const int i : blocks[b])
      if (i >= 0 && (holders[i].empty() || holders[i].back() != static_cast<int>(b)))
        holders[i].push_back(static_cast<int>(b));
  std::vector<char> has_others(blocks.size(), 0);
  for (const std::vector<int>& holding : holders)
    if (holding.size() > 1)
      for (const int b : holding) has_others[b] = 1;
  Groups groups;
  groups.of_block.resize(blocks.size());
  groups.alone.resize(blocks.size());
  std::map<std::vector<int>, int> known;
  for (int i = 0; i < size; ++i) {
    const std::vector<int>& holding = holders[i];
    if (holding.size() == 1 && has_others[holding[0]]) {
      groups.alone[holding[0]].push_back(i);
      continue;
    }
    const auto [place, is_new] = known.try_emplace(holding, static_cast<int>(groups.unknowns.size()));
    if (is_new) {
      groups.unknowns.emplace_back();
      for (const int b : holding) groups.of_block[b].push_back(place->second);
    }
    groups.unknowns[place->second].push_back(i);
  }
  return groups;
}

/// Elimination order of the groups, first to last.
std::vector<int> least_degree(const Groups& groups) {
  const auto count = static_cast<int>(groups.unknowns.size());
  std::vector<Eigen::Triplet<char>> entries;
  for (const std::vector<int>& block : groups.of_block)
    for (const int i : block)
      for (const int j : block) entries.emplace_back(i, j, char{1});
  Eigen::SparseMatrix<char> pattern(count, count);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern, order);
  return {order.indices().data(), order.indices().data() + count};
}

/// Front over groups, numbered in elimination order.
struct GroupFront {
  std::vector<int> pivots;
  std::vector<int> rest;  ///< ascending
  std::vector<int> blocks;
  std::vector<int> children;
  bool merged = false;  ///< merged into its parent
};

std::vector<GroupFront> symbolic(const Groups& groups, const std::vector<int>& place) {
  const auto count = static_cast<int>(groups.unknowns.size());
  std::vector<GroupFront> fronts(static_cast<std::size_t>(count));
  std::vector<std::vector<int>> rows(groups.of_block.size());
  for (std::size_t b = 0; b < rows.size(); ++b) {
    for (const int g : groups.of_block[b]) rows[b].push_back(place[g]);
    if (!rows[b].empty())
      fronts[*std::min_element(rows[b].begin(), rows[b].end())].blocks.push_back(static_cast<int>(b));
  }
  std::vector<int> seen(static_cast<std::size_t>(count), -1);
  for (int k = 0; k < count; ++k) {
    GroupFront& front = fronts[k];
    front.pivots = {k};
    seen[k] = k;
    const auto add = [&](const std::vector<int>& some) {
      for (const int row : some)
        if (std::exchange(seen[row], k) != k) front.rest.push_back(row);
    };
    for (const int b : front.blocks) add(rows[b]);
    for (const int child : front.children) add(fronts[child].rest);
    std::sort(front.rest.begin(), front.rest.end());
    if (!front.rest.empty()) fronts[front.rest.front()].children.push_back(k);
  }
  return fronts;
}

/// Merges a front with a child whose rest is the whole front: the same operations in fewer steps.
void merge(std::vector<GroupFront>& fronts) {
  for (GroupFront& front : fronts) {
    std::vector<int> children;
    for (const int c : std::exchange(front.children, {})) {
      GroupFront& child = fronts[c];
      const std::size_t rows = front.pivots.size() + front.rest.size();
      if (child.rest.size() < rows) {
        children.push_back(c);
        continue;
      }
      child.merged = true;
      front.pivots.insert(front.pivots.begin(), child.pivots.begin(), child.pivots.end());
      front.blocks.insert(front.blocks.end(), child.blocks.begin(), child.blocks.end());
      children.insert(children.end(), child.children.begin(), child.children.end());
    }
    front.children = std::move(children);
  }
}

std::vector<FrontPlan> over_unknowns(const std::vector<GroupFront>& fronts, const Groups& groups,
                                     const std::vector<int>& order) {
  std::vector<FrontPlan> plans;
  std::vector<int> number(fronts.size(), -1);
  for (std::size_t k = 0; k < fronts.size(); ++k) {
    if (fronts[k].merged) continue;
    number[k] = static_cast<int>(plans.size());
    FrontPlan& plan = plans.emplace_back();
    const auto add = [](std::vector<int>& to, const std::vector<int>& some) {
      to.insert(to.end(), some.begin(), some.end());
    };
    for (const int row : fronts[k].pivots) add(plan.pivots, groups.unknowns[order[row]]);
    for (const int b : fronts[k].blocks) add(plan.pivots, groups.alone[b]);
    for (const int row : fronts[k].rest) add(plan.rest, groups.unknowns[order[row]]);
    plan.blocks = fronts[k].blocks;
    for (const int child : fronts[k].children) plan.children.push_back(number[child]);
  }
  return plans;
}

}  // namespace

std::vector<FrontPlan> plan_elimination(int size, std::span<const std::vector<int>> blocks) {
  if (size <= FrontPlan::one_dense) {
    FrontPlan all;
    all.pivots.resize(static_cast<std::size_t>(size));
    std::iota(all.pivots.begin(), all.pivots.end(), 0);
    all.blocks.resize(blocks.size());
    std::iota(all.blocks.begin(), all.blocks.end(), 0);
    return {all};
  }
  const Groups groups = group(size, blocks);
  const std::vector<int> order = least_degree(groups);
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = static_cast<int>(k);
  std::vector<GroupFront> fronts = symbolic(groups, place);
  merge(fronts);
  return over_unknowns(fronts, groups, order);
}

}  // namespace snapthrough
