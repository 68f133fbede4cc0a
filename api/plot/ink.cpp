#include "api/plot/ink.h"

#include <string>
#include <utility>

#include "api/plot/plot_error.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::plot {
namespace {

thread_local Ink* innermost = nullptr;

}  // namespace

Ink::Ink(std::size_t most) : most_(most), left_(most), outer_(std::exchange(innermost, this)) {}

Ink::~Ink() { innermost = outer_; }

void Ink::require(std::size_t coordinates) {
  WorkLimit::poll();
  if (innermost != nullptr && coordinates > innermost->left_) {
    throw PlotError("", "the figure would have more than " + std::to_string(innermost->most_) +
                            " coordinates, which is the bound here: draw a part of the document");
  }
}

void Ink::spend(std::size_t coordinates) {
  require(coordinates);
  if (innermost != nullptr) {
    innermost->left_ -= coordinates;
  }
}

}  // namespace snapthrough::api::plot
