#include "solver/resolve/pretension.h"

#include <cmath>

namespace snapthrough {

std::array<double, 2> displacement_without_force(const Spring& spring, const Node& at, const Node& to) {
  const double dx = to.x - at.x;
  const double dy = to.y - at.y;
  const double towards = dx * (*spring.direction)[0] + dy * (*spring.direction)[1] >= 0.0 ? 1.0 : -1.0;
  double shortening = -spring.lengthening[0];
  if (const auto& given = spring.pretension)
    shortening +=
        given->force ? *given->force / spring.stiffness : std::hypot(dx, dy) - *given->unstressed_length;
  return {towards * shortening, -towards * spring.lengthening[1]};
}

InitialStrain strain_without_force(const Member& member, const Node& start, const Node& end,
                                   const AlongMember& EA) {
  const Pretension& given = *member.pretension;
  InitialStrain out;
  out.member = member.id;
  out.axial = given.force ? -*given.force / EA.constant
                          : *given.unstressed_length / std::hypot(end.x - start.x, end.y - start.y) - 1.0;
  out.pattern = Pattern::constant;
  return out;
}

}  // namespace snapthrough
