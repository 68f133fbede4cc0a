#pragma once
/// @file
/// Loads as basic actions: one function for each kind of load.
///
/// resolve() calls the function of a load's kind by overloading. A kind of load without a function here does
/// not compile.

#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// @brief Adds the actions of one load to those of a model.
/// @pre members, sections and nodes of the model are set
class LoadActions {
 public:
  /// @param load index of the load @param out kept by reference; must outlive this object
  LoadActions(int load, ResolvedModel& out) : load_(load), out_(out) {}

  void add(const AtLocation<PointLoad>& load);
  void add(const OnMember<DistributedLoad>& load);
  void add(const OnMember<PressureLoad>& load);
  void add(const OnMember<InitialStrain>& load);
  /// @pre the sections of all members have a mass
  void add(const SelfWeight& load);
  /// @pre the section of the member has an expansion
  void add(const OnMember<TemperatureLoad>& load);
  /// Adds the constant strain of a member with a pretension.
  void add_pretension(int member);

 private:
  void act_on(int member, Action action);
  [[nodiscard]] std::string named(int member) const;

  int load_;
  ResolvedModel& out_;
};

}  // namespace snapthrough
