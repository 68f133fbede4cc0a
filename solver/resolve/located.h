#pragma once
/// @file
/// Places of a model by index.

namespace snapthrough {

/// Location with indices. Exactly one of `node`, `member` is not -1.
struct ResolvedLocation {
  int node = -1;
  int member = -1;
  double fraction = 0.0;  ///< fraction of the member's undeformed length
  [[nodiscard]] bool is_on_member() const { return member >= 0; }
  bool operator==(const ResolvedLocation&) const = default;
};

/// What acts on a member.
template <class T>
struct OnMember : T {
  int member = -1;
  bool operator==(const OnMember&) const = default;
};

/// What acts at a location.
template <class T>
struct AtLocation : T {
  ResolvedLocation at;
  bool operator==(const AtLocation&) const = default;
};

}  // namespace snapthrough
