#include "api/plot/chain.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace snapthrough::api::plot {
namespace {

/// Members at a node.
using Joined = std::map<std::string, std::vector<const ModelMember*>>;

/// Returns the one other member at a node; null at an end and at a branching.
const ModelMember* next_at(const Joined& joined, const std::string& node, const ModelMember* from) {
  const std::vector<const ModelMember*>& there = joined.at(node);
  if (there.size() != 2) {
    return nullptr;
  }
  return there[0] == from ? there[1] : there[0];
}

/// Returns the members of a chain from one of its ends. @param node the node at which `first` begins
std::vector<Chain::Link> followed(const Joined& joined, const ModelMember* first, std::string node,
                                  std::set<const ModelMember*>& passed) {
  std::vector<Chain::Link> links;
  double from = 0;
  for (const ModelMember* at = first; at != nullptr && passed.insert(at).second;
       at = next_at(joined, node, at)) {
    const bool backwards = at->start != node;
    links.push_back({at, backwards, from});
    from += at->axis.s.back();
    node = backwards ? at->start : at->end;
  }
  return links;
}

/// Returns the points of a chain from its start to its end.
std::vector<Point> points_of(const std::vector<Chain::Link>& links) {
  std::vector<Point> points;
  for (const Chain::Link& link : links) {
    const Axis& axis = link.member->axis;
    const std::size_t count = axis.s.size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t k = link.backwards ? count - 1 - i : i;
      points.push_back({axis.x[k], axis.y[k]});
    }
  }
  return points;
}

/// Turns a chain that goes up, and sets whether it goes down.
void set_sense(Chain& chain) {
  std::vector<Point> points = points_of(chain.links);
  if (points.back().y > points.front().y) {
    std::reverse(points.begin(), points.end());
    std::reverse(chain.links.begin(), chain.links.end());
    double from = 0;
    for (Chain::Link& link : chain.links) {
      link.backwards = !link.backwards;
      link.from = from;
      from += link.member->axis.s.back();
    }
  }
  const double down = points.front().y - points.back().y;
  double across = 0;
  bool always = true;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double aside = std::abs(points[i].x - points[i - 1].x);
    const double step = points[i - 1].y - points[i].y;
    across += aside;
    always = always && (step > 0 || (step == 0 && aside == 0));  // members share the node between them
  }
  chain.goes_down = always && down > across;
}

}  // namespace

std::vector<Chain> chains_of(const std::vector<const ModelMember*>& members) {
  Joined joined;
  for (const ModelMember* member : members) {
    joined[member->start].push_back(member);
    joined[member->end].push_back(member);
  }
  std::set<const ModelMember*> passed;
  std::vector<Chain> chains;
  const auto add = [&](const ModelMember* first, const std::string& node) {
    if (!passed.contains(first)) {
      chains.push_back({followed(joined, first, node, passed), false});
      set_sense(chains.back());
    }
  };
  for (const ModelMember* member : members) {  // from the ends of chains, then the closed ones
    for (const std::string* node : {&member->start, &member->end}) {
      if (joined.at(*node).size() != 2) {
        add(member, *node);
      }
    }
  }
  for (const ModelMember* member : members) {
    add(member, member->start);
  }
  return chains;
}

double coordinate_on(const Chain& chain, std::size_t link, double fraction) {
  const Chain::Link& at = chain.links[link];
  const Axis& axis = at.member->axis;
  const double s = fraction * axis.s.back();
  if (chain.goes_down) {
    return interpolate(axis.s, axis.y, s);
  }
  return at.from + (at.backwards ? axis.s.back() - s : s);
}

}  // namespace snapthrough::api::plot
