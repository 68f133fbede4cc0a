#include "solver/sweep/model_family.h"

#include <algorithm>
#include <cmath>

#include "solver/analysis/analyses.h"
#include "solver/discrete/build_structure.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

ModelFamily::ModelFamily(std::function<Model(double)> model, Analysis analysis, bool logarithmic, double from,
                         double to)
    : model_([model = std::move(model)](double value) { return resolve(model(value)); }),
      analysis_(std::move(analysis)),
      logarithmic_(logarithmic),
      lowest_(coordinate_of(std::min(from, to))),
      highest_(coordinate_of(std::max(from, to))),
      value_lowest_(std::min(from, to)),
      value_highest_(std::max(from, to)) {}

double ModelFamily::coordinate_of(double value) const { return logarithmic_ ? std::log(value) : value; }

double ModelFamily::value_at(double t) const {
  // the rounding of the logarithm does not lead out of the values
  return std::clamp(logarithmic_ ? std::exp(t) : t, value_lowest_, value_highest_);
}

std::shared_ptr<FamilyMember> ModelFamily::at(double t) const {
  ResolvedModel model = model_(value_at(t));
  const ModeOffsets modes = mode_offsets(model, analysis_, reference_->structure.stop);
  Structure structure = with_changed_model(reference_->structure, std::move(model), modes);
  if (structure.size != reference_->structure.size) return nullptr;
  return std::make_shared<FamilyMember>(std::move(structure));
}

}  // namespace snapthrough
