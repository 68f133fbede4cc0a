#include <algorithm>
#include <cmath>

#include "api/plot/axes.h"
#include "api/plot/figures.h"
#include "api/plot/labels.h"
#include "api/plot/result.h"
#include "api/plot/sections.h"

namespace snapthrough::api::plot {
namespace {

/// Returns the values of a quantity of a member, its extremes among them.
SectionLine line_of(const MemberState& state, const char* name, const std::vector<double>& values) {
  SectionLine line{state.s, values};
  if (const auto peaks = state.extremes.find(name); peaks != state.extremes.end()) {
    add_peaks(peaks->second, line.s, line.values);
  }
  return line;
}

}  // namespace

Figure sections_figure(const ResultInput& input, const PlotRequest& request, Size size) {
  const std::size_t index = chosen_state(input.result, request.state);
  const State state = read_state(input.result, index);
  std::vector<std::string> ids;
  if (input.model) {
    for (const ModelMember& member : input.model->members) {
      ids.push_back(member.id);
    }
    std::erase_if(ids, [&](const std::string& id) { return !state.members.contains(id); });
  } else {
    for (const auto& [id, member] : state.members) {
      ids.push_back(id);
    }
    ids = naturally_sorted(std::move(ids));
  }
  Sections sections;
  sections.units = input.units;
  sections.panels = {{"axial force N", "section-N", unit_of(input.units, Quantity::force), {}},
                     {"shear force Q", "section-Q", unit_of(input.units, Quantity::force), {}},
                     {"bending moment M", "section-M", unit_of(input.units, Quantity::moment), {}}};
  for (const std::string& id : ids) {
    const MemberState& member = state.members.at(id);
    sections.members.push_back({id, member.s.back()});
    sections.panels[0].lines.push_back(line_of(member, "axial_force", member.axial_force));
    sections.panels[1].lines.push_back(line_of(member, "shear_force", member.shear_force));
    sections.panels[2].lines.push_back(line_of(member, "bending_moment", member.bending_moment));
  }
  // Smaller values are rounding; the limit of moments is relative to the largest force times the length.
  const double force = std::max(largest_of(sections.panels[0]), largest_of(sections.panels[1]));
  sections.panels[0].negligible = sections.panels[1].negligible = kRoundingOfSections * force;
  sections.panels[2].negligible = kRoundingOfSections * force * length_of(sections);
  const std::string at = "load factor " + format_number(state.load_factor, 5);
  return draw_sections(sections, "Section forces at " + at, size);
}

}  // namespace snapthrough::api::plot
