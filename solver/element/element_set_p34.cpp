#include "solver/element/element_set_impl.h"

namespace snapthrough {
template class ElementSetOf<3>;
template class ElementSetOf<4>;
}  // namespace snapthrough
