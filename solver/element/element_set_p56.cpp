#include "solver/element/element_work.h"

namespace snapthrough {
template class ElementSetOf<5>;
template class ElementSetOf<6>;
}  // namespace snapthrough
