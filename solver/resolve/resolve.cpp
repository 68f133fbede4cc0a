#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "solver/model/id_index.h"
#include "solver/resolve/load_actions.h"
#include "solver/resolve/pretension.h"
#include "solver/resolve/resolved_model.h"
#include "solver/resolve/rods.h"

namespace snapthrough {
namespace {

class Resolver {
 public:
  explicit Resolver(const Model& model)
      : model_(model), nodes_(model.nodes), sections_(model.sections), members_(model.members) {}

  [[nodiscard]] ResolvedModel resolve() const;

 private:
  [[nodiscard]] ResolvedLocation located(const Location& at) const {
    return at.member.empty() ? ResolvedLocation{nodes_.of(at.node), -1, at.fraction}
                             : ResolvedLocation{-1, members_.of(at.member), at.fraction};
  }
  [[nodiscard]] ResolvedMember resolved(const Member& member) const {
    return {member, nodes_.of(member.start), nodes_.of(member.end), sections_.of(member.section)};
  }
  [[nodiscard]] ResolvedSupport resolved(const Support& support) const {
    return {support, nodes_.of(support.node)};
  }
  [[nodiscard]] ResolvedSpring resolved(const Spring& spring) const {
    ResolvedSpring out{spring, located(spring.at), std::nullopt};
    if (spring.to) out.to = located(*spring.to);
    const auto node = [this](int index) -> const Node& {
      return model_.nodes[static_cast<std::size_t>(index)];
    };
    if (out.has_length())
      out.without_force = displacement_without_force(spring, node(out.at.node), node(out.to->node));
    return out;
  }
  template <class T>
  [[nodiscard]] auto resolved(const T& one) const {
    if constexpr (requires { one.member; })
      return OnMember<T>{one, members_.of(one.member)};
    else if constexpr (requires { one.at; })
      return AtLocation<T>{one, located(one.at)};
    else
      return one;
  }
  template <class T>
  [[nodiscard]] auto all(const std::vector<T>& given) const {
    std::vector<decltype(resolved(given.front()))> out;
    out.reserve(given.size());
    for (const T& one : given) out.push_back(resolved(one));
    return out;
  }

  const Model& model_;
  IdIndex nodes_;
  IdIndex sections_;
  IdIndex members_;
};

ResolvedModel Resolver::resolve() const {
  ResolvedModel out;
  out.nodes = model_.nodes;
  out.sections = model_.sections;
  out.members = all(model_.members);
  out.supports = all(model_.supports);
  out.springs = all(model_.springs);
  out.foundations = all(model_.foundations);
  out.actions_on_member.resize(out.members.size());
  for (std::size_t i = 0; i < model_.loads.size(); ++i) {
    LoadActions actions(static_cast<int>(i), out);
    std::visit([&](const auto& load) { actions.add(resolved(load)); }, model_.loads[i]);
  }
  for (std::size_t m = 0; m < out.members.size(); ++m)
    if (out.members[m].pretension) LoadActions(-1, out).add_pretension(static_cast<int>(m));
  for (const Imperfection& imperfection : model_.imperfections)
    std::visit([&](const auto& one) { out.imperfections.emplace_back(resolved(one)); }, imperfection);
  out.masses = all(model_.masses);
  out.damping = model_.damping;
  out.monitors = all(model_.monitors);
  return out;
}

}  // namespace

ResolvedModel resolve(const Model& model) {
  const std::optional<Model> acting = with_rods_as_springs(model);
  return Resolver(acting ? *acting : model).resolve();
}

}  // namespace snapthrough
