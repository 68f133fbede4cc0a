#include "api/read_refine.h"

#include <algorithm>
#include <string>

namespace snapthrough::api {
namespace {

/// Least number of parts of the last parameter's range and of that before it. They resolve jumps to 1/4096
/// and 1/1024 of the range.
constexpr int kLeastParts = 4096;
constexpr int kLeastOuterParts = 1024;
constexpr int kMostFirstParts = 1024;
constexpr int kCurvePoints = 1000;
constexpr int kSurfacePoints = 20'000;

void read_fields(const Value& refine, SweepRefine& out) {
  Object in(refine);
  in.required("output", out.output);
  in.optional("within", out.within);
  in.optional("parameters", out.parameters);
  out.most = out.parameters == 2 ? kSurfacePoints : kCurvePoints;
  in.optional("most", out.most);
  const auto check = [&](std::string_view key, bool valid, const std::string& rule) {
    if (const auto value = in.find(key); value && value->is_number() && !valid) {
      value->report("out_of_range", rule);
    }
  };
  check("within", out.within >= 1e-4 && out.within <= 0.5, "within is 1e-4 to 0.5, a share of the output");
  check("parameters", out.parameters == 1 || out.parameters == 2, "the last 1 or 2 parameters are refined");
  check("most", out.most >= 3 && out.most <= kMostRefined,
        "most is 3 to " + std::to_string(kMostRefined) + " points of a curve or surface");
  in.finish();
}

/// Divides a range. Returns why it cannot be refined; "" when it can.
std::string divide(SweepParameter& parameter, int least) {
  if (!parameter.range) {
    return parameter.name + " has no range";
  }
  SweepRange& range = *parameter.range;
  if (range.from == range.to || range.count - 1 > kMostFirstParts) {
    return "the range of " + parameter.name +
           (range.from == range.to
                ? " has no length"
                : " begins with more than " + std::to_string(kMostFirstParts + 1) + " values");
  }
  range.first_parts = range.count - 1;
  int parts = range.first_parts;
  while (parts < least) {
    parts *= 2;
  }
  range.count = parts + 1;
  return "";
}

/// Reports columns of parameters that the rows of a refined sweep have themselves.
void check_names(const SweepData& data, const Value& refine) {
  for (const SweepParameter& parameter : data.parameters) {
    if (parameter.name == kPieceColumn || parameter.name == kChangeColumn) {
      refine.report("invalid_name",
                    "a refined sweep has columns of its own that are named piece and change, "
                    "and so is a parameter");
    }
  }
}

}  // namespace

void read_refine(Object& root, SweepData& data) {
  const auto refine = root.find("refine");
  if (!refine) {
    return;
  }
  SweepRefine out;
  read_fields(*refine, out);
  if (!refine->document_report().findings().empty()) {
    return;  // the rules need the rest of the document
  }
  const auto output = std::find_if(data.outputs.begin(), data.outputs.end(),
                                   [&](const SweepOutput& one) { return one.pointer == out.output; });
  if (output == data.outputs.end()) {
    refine->report("unknown_reference",
                   "refine.output is one of the outputs, which do not have " + out.output);
    return;
  }
  out.number = static_cast<std::size_t>(output - data.outputs.begin());
  if (data.follow || data.design != SweepDesign::grid) {
    refine->report("not_supported", data.follow ? "a sweep has follow or refine, not both"
                                                : "points are added to a grid only");
    return;
  }
  const auto refined = static_cast<std::size_t>(out.parameters);
  if (data.parameters.size() < refined) {
    refine->report("out_of_range", "the sweep has fewer than " + std::to_string(refined) + " parameters");
    return;
  }
  check_names(data, *refine);
  for (std::size_t i = 1; i <= refined; ++i) {
    SweepParameter& parameter = data.parameters[data.parameters.size() - i];
    if (const std::string why = divide(parameter, i == 1 ? kLeastParts : kLeastOuterParts); !why.empty()) {
      refine->report("not_supported", "points are added over a range: " + why);
    }
  }
  data.refine = out;
}

}  // namespace snapthrough::api
