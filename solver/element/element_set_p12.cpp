#include "solver/element/element_set_impl.h"

namespace snapthrough {
template class ElementSetOf<1>;
template class ElementSetOf<2>;
}  // namespace snapthrough
