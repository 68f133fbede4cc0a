/// Writes the request of a seed, to be solved by itself: stress_request first|broad|frame SEED > request.json
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/stress/broad_model.h"
#include "tests/stress/frame_model.h"
#include "tests/stress/request_text.h"

int main(int argc, char** argv) {
  using namespace snapthrough::testing;
  const std::string draw = argc == 3 ? argv[1] : "";
  if (draw != "first" && draw != "broad" && draw != "frame") {
    std::fprintf(stderr, "usage: stress_request first|broad|frame SEED\n");
    return 2;
  }
  const unsigned long seed = std::strtoul(argv[2], nullptr, 10);
  constexpr double kAccuracyOfFrames = 1e-3;
  const RandomRequest request = draw == "first"   ? random_request(seed)
                                : draw == "broad" ? broad_request(seed)
                                                  : frame_request(seed, kAccuracyOfFrames);
  std::printf("%s\n", request_text(request).c_str());
  return 0;
}
