#include "solver/element/element_work.h"

namespace snapthrough {
template class ElementSetOf<1>;
template class ElementSetOf<2>;
}  // namespace snapthrough
