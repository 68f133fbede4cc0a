/// Uses of the list of foundations: explicit models, and places of findings.

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "api/list_foundations.h"

namespace snapthrough::api {

namespace {

using nlohmann::json;

/// Splits "/model/foundations/7/law" into 7 and "/law" for the list "/model/foundations/"; nullopt for other
/// pointers.
std::optional<std::pair<std::size_t, std::string>> index_and_rest(std::string_view list,
                                                                  std::string_view pointer) {
  if (!pointer.starts_with(list)) {
    return std::nullopt;
  }
  pointer.remove_prefix(list.size());
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(pointer.data(), pointer.data() + pointer.size(), index);
  if (error != std::errc()) {
    return std::nullopt;
  }
  return std::pair(index, std::string(end, pointer.data() + pointer.size()));
}

/// Places of foundations and springs in a request whose soil gives some of them.
class SupportPlaces {
 public:
  explicit SupportPlaces(const json& model) {
    Report report;
    listed_ = list_foundations(Value(model, PointerPath("/model"), report));
    const auto springs = model.find("springs");
    own_springs_ = springs != model.end() && springs->is_array() ? springs->size() : 0;
  }

  /// Replaces a pointer to a listed support by that of its entry. Returns whether the soil gives the support.
  bool name(std::string& pointer) const {
    if (const auto at = index_and_rest(kFoundations, pointer); at && at->first < listed_.foundations.size()) {
      return name(listed_.foundations[at->first], at->second, pointer);
    }
    const auto at = index_and_rest(kSprings, pointer);
    if (at && at->first >= own_springs_ && at->first - own_springs_ < listed_.springs.size()) {
      return name(listed_.springs[at->first - own_springs_], at->second, pointer);
    }
    return false;
  }

  static constexpr std::string_view kFoundations = "/model/foundations/";
  static constexpr std::string_view kSprings = "/model/springs/";

 private:
  static bool name(const ListedSupport& support, const std::string& rest, std::string& pointer) {
    const bool is_made = !support.made.is_null();
    const bool has_field = !is_made || rest == "/id" || rest == "/member";
    pointer = std::string(kFoundations) + std::to_string(support.entry) + (has_field ? rest : std::string());
    return is_made;
  }

  ListedSupports listed_;
  std::size_t own_springs_ = 0;
};

}  // namespace

json with_laws_of_soil(const json& model) {
  Report report;
  json out = model;
  ListedSupports listed = list_foundations(Value(model, PointerPath("/model"), report));
  json foundations = json::array();
  for (ListedSupport& one : listed.foundations) {
    if (one.made.is_null()) {
      foundations.push_back(model.at("foundations").at(one.entry));
    } else if (!report.covers(std::string(SupportPlaces::kFoundations) + std::to_string(one.entry))) {
      foundations.push_back(std::move(one.made));
    }
  }
  out.erase("soils");
  out["foundations"] = std::move(foundations);
  json& springs = out["springs"];
  if (springs.is_null()) {
    springs = json::array();
  }
  for (ListedSupport& one : listed.springs) {
    if (springs.is_array()) {
      springs.push_back(std::move(one.made));
    }
  }
  return out;
}

void name_foundation_entries(const json& document, std::vector<Finding>& findings) {
  const bool is_meant = std::any_of(findings.begin(), findings.end(), [](const Finding& one) {
    return one.pointer.starts_with(SupportPlaces::kFoundations) ||
           one.pointer.starts_with(SupportPlaces::kSprings);
  });
  const auto model = is_meant ? document.find("model") : document.end();
  if (model == document.end() || !has_soil(*model)) {
    return;
  }
  const SupportPlaces places(*model);
  std::vector<Finding> named;
  for (Finding& finding : findings) {
    const bool is_made = places.name(finding.pointer);
    const auto is_same = [&](const Finding& one) {
      return one.pointer == finding.pointer && one.code == finding.code;
    };
    if (!is_made || std::none_of(named.begin(), named.end(), is_same)) {
      named.push_back(std::move(finding));
    }
  }
  findings = std::move(named);
}

}  // namespace snapthrough::api
