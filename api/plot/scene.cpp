#include "api/plot/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "api/plot/plot_error.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::plot {
namespace {

constexpr double kGroundDepth = 0.13;  // depth of the ground relative to the extent

void set_normals(DrawnMember& member) {
  member.normals = left_normals(member.x0, member.y0);
  for (const Point& normal : member.normals) {
    member.normal_x.push_back(normal.x);
    member.normal_y.push_back(normal.y);
  }
}

DrawnMember drawn_member(const std::string& id, const Axis* axis, const MemberState* state, double factor) {
  DrawnMember member;
  member.id = id;
  if (state != nullptr) {
    member.s = state->s;
    member.x0 = state->x0;
    member.y0 = state->y0;
    member.x = state->x;
    member.y = state->y;
    for (std::size_t i = 0; factor != 1 && i < member.s.size(); ++i) {
      member.x[i] = state->x0[i] + factor * state->u[i];
      member.y[i] = state->y0[i] + factor * state->v[i];
    }
  } else {
    member.s = axis->s;
    member.x = member.x0 = axis->x;
    member.y = member.y0 = axis->y;
  }
  set_normals(member);
  return member;
}

const MemberState* state_of(const SceneInput& input, const std::string& id) {
  if (input.state == nullptr) {
    return nullptr;
  }
  const auto found = input.state->members.find(id);
  return found == input.state->members.end() ? nullptr : &found->second;
}

/// Throws unless the scene has each member of a state or mode.
template <class Named>
void need_members(const Scene& scene, const Named& named) {
  for (const auto& [id, shape] : named) {
    if (scene.member(id) == nullptr && scene.input.model == nullptr) {
      throw PlotError("/states", "has no member \"" + id + "\", which the mode has");
    }
    if (scene.member(id) == nullptr) {
      throw PlotError("request:/model/members", "has no member \"" + id +
                                                    "\", which the result has: it is not the request of this "
                                                    "result");
    }
  }
}

void add_joint(Scene& scene, const std::string& node, const DrawnMember& member, bool at_start) {
  const std::size_t i = at_start ? 0 : member.s.size() - 1;
  const std::size_t next = at_start ? 1 : member.s.size() - 2;
  const double dx = member.x0[next] - member.x0[i];
  const double dy = member.y0[next] - member.y0[i];
  const double length = std::hypot(dx, dy);
  const auto [joint, is_new] =
      scene.joints.try_emplace(node, Joint{{member.x0[i], member.y0[i]}, {member.x[i], member.y[i]}, {}});
  if (length > 0) {
    joint->second.leaving.push_back({dx / length, dy / length});
  }
}

void add_members(Scene& scene) {
  const SceneInput& input = scene.input;
  if (input.model != nullptr) {
    for (const ModelMember& member : input.model->members) {
      scene.members.push_back(
          drawn_member(member.id, &member.axis, state_of(input, member.id), input.factor));
      add_joint(scene, member.start, scene.members.back(), true);
      add_joint(scene, member.end, scene.members.back(), false);
    }
  } else {
    std::vector<std::string> ids;
    ids.reserve(input.state->members.size());
    for (const auto& [id, state] : input.state->members) {
      ids.push_back(id);
    }
    for (const std::string& id : naturally_sorted(std::move(ids))) {
      scene.members.push_back(drawn_member(id, nullptr, &input.state->members.at(id), input.factor));
    }
  }
  // Scene::member() uses a binary search.
  std::stable_sort(scene.members.begin(), scene.members.end(),
                   [](const DrawnMember& a, const DrawnMember& b) { return a.id < b.id; });
}

/// @brief Returns x of the symmetry line if the model is one half of a structure: at least two supports on
/// the line fix x and rotation only, and all members lie on one side of the line.
std::optional<double> symmetry_line(const Scene& scene) {
  if (scene.input.model == nullptr) {
    return std::nullopt;
  }
  const double slack = 1e-6 * scene.extent;
  std::vector<double> places;
  for (const ModelSupport& support : scene.input.model->supports) {
    const auto node = scene.input.model->nodes.find(support.node);
    if (support.x && support.rotation && !support.y && support.angle == 0 &&
        node != scene.input.model->nodes.end()) {
      places.push_back(node->second.x);
    }
  }
  if (places.size() < 2) {
    return std::nullopt;
  }
  const double x = places.front();
  const auto off_line = [&](double place) { return std::abs(place - x) > slack; };
  if (std::any_of(places.begin(), places.end(), off_line)) {
    return std::nullopt;
  }
  ModelBox still;
  for (const DrawnMember& member : scene.members) {
    for (const double place : member.x0) {
      still.include(place, 0);
    }
  }
  return still.left >= x - slack || still.right <= x + slack ? std::optional(x) : std::nullopt;
}

double depth_of(const Scene& scene) {
  double depth = kGroundDepth * scene.extent;
  for (const ModelFoundation& foundation : scene.foundations) {
    if (foundation.gap < scene.extent) {
      depth = std::max(depth, 0.8 * foundation.gap);
    }
  }
  return depth;
}

struct Margin {
  double left, right, top, bottom;
};

/// Returns pixels around structure and ground for caption, arrows, symbols and dimensions.
Margin margin_of(const Scene& scene) {
  bool points = false;
  bool sideways = false;
  bool any = false;
  if (scene.input.model != nullptr) {
    for (const ModelLoad& load : scene.input.model->loads) {
      any = true;
      points = points || load.type == ModelLoad::Type::point;
      sideways = sideways || (load.type == ModelLoad::Type::point && load.force.x != 0);
    }
  }
  const bool forces = !scene.support_forces.empty();
  return {forces ? 76.0 : 58.0, sideways || forces ? 76.0 : 40.0,
          (points          ? 54.0
           : any || forces ? 36.0
                           : 24.0) +
              18,
          forces ? 84.0 : 58.0};
}

}  // namespace

ModelBox::ModelBox()
    : left(std::numeric_limits<double>::infinity()), right(-left), bottom(left), top(-left) {}

void ModelBox::include(double x, double y) {
  left = std::min(left, x);
  right = std::max(right, x);
  bottom = std::min(bottom, y);
  top = std::max(top, y);
}

const DrawnMember* Scene::member(const std::string& id) const {
  const auto found =
      std::lower_bound(members.begin(), members.end(), id,
                       [](const DrawnMember& one, const std::string& name) { return one.id < name; });
  return found == members.end() || found->id != id ? nullptr : &*found;
}

Scene make_scene(const SceneInput& input) {
  Scene scene;
  scene.input = input;
  add_members(scene);
  if (input.state != nullptr) {
    need_members(scene, input.state->members);
  }
  if (input.mode != nullptr) {
    need_members(scene, *input.mode);
  }
  ModelBox still;
  for (const DrawnMember& member : scene.members) {
    for (std::size_t i = 0; i < member.s.size(); ++i) {
      still.include(member.x0[i], member.y0[i]);
      scene.box.include(member.x0[i], member.y0[i]);
      scene.box.include(member.x[i], member.y[i]);
    }
  }
  const double larger = std::max(still.right - still.left, still.top - still.bottom);
  scene.extent = larger > 0 ? larger : 1;
  if (input.model != nullptr) {
    scene.foundations = input.model->foundations;
  } else {
    scene.foundations = foundations_of(scene.members, *input.state);
    scene.support_forces = support_forces_of(scene.members, *input.state);
  }
  scene.depth = depth_of(scene);
  scene.mirror = symmetry_line(scene);
  return scene;
}

Pixel to_pixel(const View& view, Point point) {
  return {view.left + view.scale * point.x, view.top - view.scale * point.y};
}

std::vector<Pixel> to_pixels(const View& view, const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<Pixel> pixels;
  for (std::size_t i = 0; i < x.size(); ++i) {
    pixels.push_back(to_pixel(view, {x[i], y[i]}));
  }
  return pixels;
}

Way way_into(const ModelFoundation& foundation, const DrawnMember& member, double s) {
  WorkLimit::poll();
  if (foundation.surface) {
    const SurfacePoint at =
        foundation.surface->at({interpolate(member.s, member.x0, s), interpolate(member.s, member.y0, s)});
    return {{at.into[0], at.into[1]}, -at.depth};
  }
  const double gap = value_at(foundation.gap, foundation.gap_along, s / member.s.back());
  if (foundation.direction) {
    return {*foundation.direction, gap};
  }
  return {{foundation.side * interpolate(member.s, member.normal_x, s),
           foundation.side * interpolate(member.s, member.normal_y, s)},
          gap};
}

ModelBox box_with_ground(const Scene& scene) {
  ModelBox box = scene.box;
  for (const ModelFoundation& foundation : scene.foundations) {
    const DrawnMember* member = scene.member(foundation.member);
    if (member == nullptr) {
      continue;
    }
    const bool pulls = scene.input.state != nullptr && !foundation.compression_only;
    for (const Point& point : foundation.line) {
      box.include(point.x, point.y);
    }
    for (std::size_t i = 0; i < member->s.size(); ++i) {
      const auto [d, gap] = way_into(foundation, *member, member->s[i]);
      const double reach = std::min(gap, scene.extent) + scene.depth;
      box.include(member->x0[i] + reach * d.x, member->y0[i] + reach * d.y);
      if (pulls) {
        const double shown = 0.8 * scene.depth;
        box.include(member->x[i] + shown * d.x, member->y[i] + shown * d.y);
        box.include(member->x[i] - shown * d.x, member->y[i] - shown * d.y);
      }
    }
  }
  if (scene.mirror) {
    const double left = box.left;
    box.include(2 * *scene.mirror - box.right, box.bottom);
    box.include(2 * *scene.mirror - left, box.bottom);
  }
  return box;
}

Size needed_size(const Scene& scene, Size size) {
  constexpr double kLeast = 120;
  const ModelBox box = box_with_ground(scene);
  const Margin margin = margin_of(scene);
  const double drawn = scene_view(scene, size).scale * (box.top - box.bottom);
  return {size.width, std::min(size.height, std::max(kLeast, drawn + margin.top + margin.bottom))};
}

View scene_view(const Scene& scene, Size size) {
  const ModelBox box = box_with_ground(scene);
  const Margin margin = margin_of(scene);
  const double width = std::max(20.0, size.width - margin.left - margin.right);
  const double height = std::max(20.0, size.height - margin.top - margin.bottom);
  const double least = 1e-9 * scene.extent;
  const double scale =
      std::min(width / std::max(box.right - box.left, least), height / std::max(box.top - box.bottom, least));
  return {scale, margin.left + width / 2 - scale * (box.left + box.right) / 2,
          margin.top + height / 2 + scale * (box.bottom + box.top) / 2};
}

Place place_on(const DrawnMember& member, double s) {
  const auto pick = [&](const std::vector<double>& values, double where) {
    return interpolate(member.s, values, where);
  };
  const double h = member.s.back() / 400;
  const auto direction = [&](const std::vector<double>& x, const std::vector<double>& y) {
    const double dx = pick(x, s + h) - pick(x, s - h);
    const double dy = pick(y, s + h) - pick(y, s - h);
    const double length = std::hypot(dx, dy);
    return length > 0 ? Point{dx / length, dy / length} : Point{1, 0};
  };
  const Point still = direction(member.x0, member.y0);
  return {{pick(member.x0, s), pick(member.y0, s)},
          {pick(member.x, s), pick(member.y, s)},
          {-still.y, still.x},
          direction(member.x, member.y),
          &member,
          s};
}

std::optional<Place> place_of(const Scene& scene, const Location& location) {
  WorkLimit::poll();
  std::string id = location.member;
  double fraction = location.fraction;
  if (!location.node.empty() && scene.input.model != nullptr) {
    for (const ModelMember& member : scene.input.model->members) {
      if (member.start == location.node || member.end == location.node) {
        id = member.id;
        fraction = member.start == location.node ? 0 : 1;
        break;
      }
    }
  }
  const DrawnMember* member = scene.member(id);
  return member == nullptr ? std::nullopt : std::optional(place_on(*member, fraction * member->s.back()));
}

double suggested_factor(const Scene& scene) {
  constexpr double kVisible = 1.0 / 60;  // displacement relative to the extent
  constexpr double kWanted = 1.0 / 12;
  double largest = 0;
  for (const DrawnMember& member : scene.members) {
    for (std::size_t i = 0; i < member.s.size(); ++i) {
      largest = std::max(largest, std::hypot(member.x[i] - member.x0[i], member.y[i] - member.y0[i]));
    }
  }
  if (!(largest > 1e-12 * scene.extent) || largest > kVisible * scene.extent) {
    return 1;
  }
  const double wanted = kWanted * scene.extent / largest;
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  const double share = wanted / power;
  return std::max(1.0, (share >= 5 ? 5 : share >= 2 ? 2 : 1) * power);
}

}  // namespace snapthrough::api::plot
