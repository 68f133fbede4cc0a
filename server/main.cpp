#include <iostream>

#include "server/cli/app.h"

int main(int argc, char** argv) {
  return snapthrough::server::cli::run(argc, argv, {std::cin, std::cout, std::cerr});
}
