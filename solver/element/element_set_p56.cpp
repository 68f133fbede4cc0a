#include "solver/element/element_set_impl.h"

namespace snapthrough {
template class ElementSetOf<5>;
template class ElementSetOf<6>;
}  // namespace snapthrough
