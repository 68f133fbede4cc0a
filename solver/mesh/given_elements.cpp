#include "solver/mesh/given_elements.h"

#include <string_view>
#include <unordered_map>

namespace snapthrough {

long long given_elements(const Model& model, const Discretization& asked) {
  const std::unordered_map<std::string_view, int> of_members(asked.member_elements.begin(),
                                                             asked.member_elements.end());
  long long elements = 0;
  for (const Member& member : model.members) {
    const auto given = of_members.find(member.id);
    elements += given == of_members.end() ? asked.elements : given->second;
  }
  return elements;
}

}  // namespace snapthrough
