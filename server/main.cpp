#include <cstdlib>
#include <iostream>
#include <string_view>

#include "server/cli/app.h"
#include "server/worker/runner_process.h"
#include "solver/solve.h"

int main(int argc, char** argv) {
  using namespace snapthrough::server;
  if (argc == 3 && std::string_view(argv[1]) == kRunnerCommand) {
    return run_runner(std::atoi(argv[2]), snapthrough::solve_checked);
  }
  return cli::run(argc, argv, {std::cin, std::cout, std::cerr});
}
