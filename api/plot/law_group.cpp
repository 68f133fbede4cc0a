#include "api/plot/law_group.h"

#include <algorithm>

#include "solver/numeric/work_limit.h"

namespace snapthrough::api::plot {

bool are_joined(const LawPlace& before, const LawPlace& after) {
  return before.last_link == after.link &&
         (after.middle - before.last_fraction) * (after.middle - after.fraction) < 0;
}

double LawSum::force_at(double w) const {
  double force = 0;
  for (const LawCurve& part : parts) {
    force += part.law.force_at(w);
  }
  return force;
}

double LawSum::reach() const {
  double reach = 0;
  for (const LawCurve& part : parts) {
    reach = std::max(reach, part.reach);
  }
  return reach;
}

double LawSum::flat_from() const {
  double from = 0;
  for (const LawCurve& part : parts) {
    from = std::max(from, part.flat_from);
  }
  return from;
}

std::span<const LawSource> LawGroup::sources_on(std::size_t link) const {
  const auto first =
      std::lower_bound(sources.begin(), sources.end(), link,
                       [](const LawSource& one, std::size_t wanted) { return one.link < wanted; });
  const auto last =
      std::find_if(first, sources.end(), [&](const LawSource& one) { return one.link != link; });
  return {first, last};
}

LawSum LawGroup::sum_at(const LawPlace& place) const {
  LawSum sum;
  for (const LawSource& source : sources_on(place.link)) {
    WorkLimit::poll();
    if (source.range[0] <= place.middle && place.middle <= source.range[1]) {
      const double fraction = std::clamp(place.fraction, source.range[0], source.range[1]);
      sum.parts.push_back(law_curve_at(source.given, source.law, fraction));
    }
  }
  return sum;
}

}  // namespace snapthrough::api::plot
