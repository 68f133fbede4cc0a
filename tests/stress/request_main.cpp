/// Writes the request of a seed, to be solved by itself: stress_request
/// first|broad|laws|media|soil|members|frame SEED > request.json
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include "tests/stress/frame_model.h"
#include "tests/stress/request_text.h"
#include "tests/stress/stress_run.h"

int main(int argc, char** argv) {
  using namespace snapthrough::testing;
  const std::string name = argc == 3 ? argv[1] : "";
  const std::optional<Draw> draw = draw_named(name);
  if (!draw && name != "frame") {
    std::fprintf(stderr, "usage: stress_request first|broad|laws|media|soil|members|frame SEED\n");
    return 2;
  }
  const unsigned long seed = std::strtoul(argv[2], nullptr, 10);
  constexpr double kAccuracyOfFrames = 1e-3;
  const RandomRequest request = draw ? draw_request(*draw, seed) : frame_request(seed, kAccuracyOfFrames);
  std::printf("%s\n", request_text(request).c_str());
  return 0;
}
