#include "solver/element/element_work.h"

namespace snapthrough {
template class ElementSetOf<3>;
template class ElementSetOf<4>;
}  // namespace snapthrough
