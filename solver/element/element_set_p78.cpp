#include "solver/element/element_work.h"

namespace snapthrough {
template class ElementSetOf<7>;
template class ElementSetOf<8>;
}  // namespace snapthrough
