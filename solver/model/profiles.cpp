#include "solver/model/profiles.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>

#include "solver/model/profile_tables.h"

namespace snapthrough {

namespace {

// ---- Forms of the series. Tapers: EN 10365:2017, as DIN 1025-1 (IPN) and DIN 1026-1 (UPN).

FlangedSection parallel_i(const FlangedSection& row) { return row; }

FlangedSection parallel_channel(const FlangedSection& row) {
  FlangedSection out = row;
  out.channel = true;
  return out;
}

/// Inner faces of slope 14 %, thickness at a quarter of the width, toe radius 0.6 of the root radius.
FlangedSection tapered_i(const FlangedSection& row) {
  FlangedSection out = row;
  out.slope = 0.14;
  out.flange_at = 0.25 * row.width;
  out.toe_radius = 0.6 * row.root_radius;
  return out;
}

/// Inner faces of slope 8 %, thickness at half of the width; above a depth of 300 mm slope 5 %, thickness at
/// half of the clear width. Toe radius half of the root radius.
FlangedSection tapered_channel(const FlangedSection& row) {
  constexpr double kLargestOfFirstForm = 300.0;
  const bool first = row.depth <= kLargestOfFirstForm;
  FlangedSection out = parallel_channel(row);
  out.slope = first ? 0.08 : 0.05;
  out.flange_at = 0.5 * (first ? row.width : row.width - row.web);
  out.toe_radius = 0.5 * row.root_radius;
  return out;
}

// ---- Names.

/// Letters and numbers of a name: "HE 200 A" and "HEA200" have the letters HEA and the number 200.
struct NameParts {
  std::string letters;
  std::vector<double> numbers;

  auto operator<=>(const NameParts&) const = default;
};

/// Letters in common use for those of the tables.
std::string in_letters_of_tables(std::string letters) {
  static constexpr std::pair<std::string_view, std::string_view> kOthers[] = {
      {"UKB", "UB"}, {"UKC", "UC"}, {"INP", "IPN"}, {"UNP", "UPN"}};
  for (const auto& [other, own] : kOthers)
    if (letters == other) return std::string(own);
  return letters;
}

bool is_digit(char c) { return (c >= '0' && c <= '9') || c == '.'; }

/// The name in upper case, with 'X' for each sign of multiplication and '.' for a comma; a blank between two
/// numbers becomes 'X', others vanish.
std::string plain(std::string_view name) {
  constexpr std::string_view kTimes = "\xC3\x97";  // U+00D7
  std::string out;
  bool blank = false;
  while (!name.empty()) {
    const bool times = name.starts_with(kTimes);
    char c = times || name[0] == '*' ? 'X' : name[0] == ',' ? '.' : name[0];
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    name.remove_prefix(times ? kTimes.size() : 1);
    if (c == ' ') {
      blank = true;
      continue;
    }
    if (blank && is_digit(c) && !out.empty() && is_digit(out.back())) out += 'X';
    blank = false;
    out += c;
  }
  return out;
}

/// Parts of a name; empty unless it is letters, numbers joined by X, letters, with numbers at all.
std::optional<NameParts> parts_of(std::string_view name) {
  const std::string text = plain(name);
  const auto is_letter = [](char c) { return c >= 'A' && c <= 'Z' && c != 'X'; };
  NameParts out;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end && is_letter(*at)) out.letters += *at++;
  while (at != end && is_digit(*at)) {
    const char* const after = std::find_if_not(at, end, is_digit);
    const auto [read, error] = std::from_chars(at, after, out.numbers.emplace_back());
    if (error != std::errc() || read != after) return std::nullopt;
    at = after;
    if (at + 1 < end && *at == 'X' && is_digit(at[1])) ++at;
  }
  while (at != end && is_letter(*at)) out.letters += *at++;
  if (at != end || out.numbers.empty() || out.letters.empty()) return std::nullopt;
  out.letters = in_letters_of_tables(std::move(out.letters));
  return out;
}

using Index = std::map<NameParts, RolledProfile>;

const Index& index() {
  static const Index all = [] {
    Index out;
    for (const ProfileSeries& series : profile_series())
      for (const Profile& profile : series.profiles)
        out[parts_of(profile.name).value()] = {&series, &profile};
    return out;
  }();
  return all;
}

/// Sum of the relative differences of the numbers; a number that only one name has counts 1.
double distance(std::span<const double> a, std::span<const double> b) {
  const std::size_t common = std::min(a.size(), b.size());
  auto out = static_cast<double>(std::max(a.size(), b.size()) - common);
  for (std::size_t i = 0; i < common; ++i) out += std::abs(a[i] - b[i]) / std::max(a[i], b[i]);
  return out;
}

}  // namespace

std::span<const ProfileSeries> profile_series() {
  constexpr std::string_view kEuropean = "EN 10365:2017";
  constexpr double kInch = 25.4;
  static const ProfileSeries all[] = {{"IPE", kEuropean, 1.0, parallel_i, ipe_profiles()},
                                      {"IPN", kEuropean, 1.0, tapered_i, ipn_profiles()},
                                      {"HE", kEuropean, 1.0, parallel_i, he_profiles()},
                                      {"HD", kEuropean, 1.0, parallel_i, hd_profiles()},
                                      {"HL", kEuropean, 1.0, parallel_i, hl_profiles()},
                                      {"HP", kEuropean, 1.0, parallel_i, hp_profiles()},
                                      {"UB", kEuropean, 1.0, parallel_i, ub_profiles()},
                                      {"UC", kEuropean, 1.0, parallel_i, uc_profiles()},
                                      {"UPE", kEuropean, 1.0, parallel_channel, upe_profiles()},
                                      {"UPN", kEuropean, 1.0, tapered_channel, upn_profiles()},
                                      {"W", "AISC", kInch, parallel_i, w_profiles()}};
  return all;
}

std::optional<RolledProfile> find_profile(std::string_view name) {
  const auto parts = parts_of(name);
  if (!parts) return std::nullopt;
  const auto found = index().find(*parts);
  return found == index().end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::string_view> profiles_near(std::string_view name) {
  constexpr std::size_t kMost = 3;
  const auto parts = parts_of(name);
  if (!parts) return {};
  const auto& [letters, numbers] = *parts;
  // The letters may be the first of several series: "HE 200" lacks the A, B or M.
  const bool whole = std::any_of(index().begin(), index().end(), [&](const Index::value_type& entry) {
    return entry.first.letters == letters && entry.first.numbers.size() == numbers.size();
  });
  std::vector<std::pair<double, std::string_view>> near;
  for (const auto& [key, rolled] : index())
    if (whole ? key.letters == letters : key.letters.starts_with(letters))
      near.emplace_back(distance(numbers, key.numbers), rolled.profile->name);
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string_view> out;
  for (const auto& [unused, found] : near)
    if (out.size() < kMost) out.push_back(found);
  return out;
}

SectionGeometry geometry_of(const RolledProfile& rolled, double millimetre) {
  const double unit = rolled.series->unit * millimetre;
  SectionGeometry out = flanged_section(scaled(rolled.series->complete(rolled.profile->section), unit));
  if (rolled.profile->area > 0.0) out.area = rolled.profile->area * unit * unit;
  if (rolled.profile->second_moment > 0.0)
    out.second_moment = rolled.profile->second_moment * unit * unit * unit * unit;
  return out;
}

}  // namespace snapthrough
