#include "solver/element/element_set.h"

#include <stdexcept>

#include "solver/element/element_data.h"

namespace snapthrough {

extern template class ElementSetOf<1>;
extern template class ElementSetOf<2>;
extern template class ElementSetOf<3>;
extern template class ElementSetOf<4>;
extern template class ElementSetOf<5>;
extern template class ElementSetOf<6>;
extern template class ElementSetOf<7>;
extern template class ElementSetOf<8>;

std::unique_ptr<ElementSet> make_element_set(int order) {
  switch (order) {
    case 1:
      return std::make_unique<ElementSetOf<1>>();
    case 2:
      return std::make_unique<ElementSetOf<2>>();
    case 3:
      return std::make_unique<ElementSetOf<3>>();
    case 4:
      return std::make_unique<ElementSetOf<4>>();
    case 5:
      return std::make_unique<ElementSetOf<5>>();
    case 6:
      return std::make_unique<ElementSetOf<6>>();
    case 7:
      return std::make_unique<ElementSetOf<7>>();
    case 8:
      return std::make_unique<ElementSetOf<8>>();
    default:
      throw std::invalid_argument("element order must be in 1..8");
  }
}

}  // namespace snapthrough
