/// Loads the library, solves a request and unloads it, so many times: memory and mappings must not grow.
///   load_unload LIBRARY REQUEST TIMES
#include <dlfcn.h>
#include <malloc.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "snapthrough.h"

namespace {

/// Bytes that are allocated and not released.
std::size_t allocated() { return mallinfo2().uordblks; }

std::size_t mappings() {
  std::ifstream maps("/proc/self/maps");
  std::size_t lines = 0;
  for (std::string line; std::getline(maps, line);) {
    ++lines;
  }
  return lines;
}

template <typename Function>
Function* found(void* library, const char* name) {
  void* symbol = dlsym(library, name);
  if (symbol == nullptr) {
    std::fprintf(stderr, "%s\n", dlerror());
    std::exit(1);
  }
  return reinterpret_cast<Function*>(symbol);
}

void solve_once(const char* path, const std::string& request) {
  void* library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    std::fprintf(stderr, "%s\n", dlerror());
    std::exit(1);
  }
  auto* solve = found<decltype(snapthrough_solve)>(library, "snapthrough_solve");
  auto* release = found<decltype(snapthrough_free)>(library, "snapthrough_free");
  snapthrough_document* document = solve(request.data(), request.size(), nullptr, nullptr, nullptr);
  if (document == nullptr || document->status != SNAPTHROUGH_DONE) {
    std::fprintf(stderr, "%s\n", document == nullptr ? "no document" : document->text);
    std::exit(1);
  }
  release(document);
  dlclose(library);
  if (dlopen(path, RTLD_NOW | RTLD_NOLOAD) != nullptr) {
    std::fprintf(stderr, "the library stays loaded\n");
    std::exit(1);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    return 2;
  }
  std::ifstream file(argv[2]);
  std::ostringstream request;
  request << file.rdbuf();
  const int times = std::atoi(argv[3]);
  const int warm = times / 2;  // until then loader and allocator fill what they keep
  std::size_t bytes = 0;
  std::size_t lines = 0;
  for (int i = 0; i < times; ++i) {
    if (i == warm) {
      bytes = allocated();
      lines = mappings();
    }
    solve_once(argv[1], request.str());
  }
  const std::size_t bytes_after = allocated();
  const std::size_t lines_after = mappings();
  std::printf("%d times: %zu bytes allocated before, %zu after; %zu mappings before, %zu after\n", times,
              bytes, bytes_after, lines, lines_after);
  // What is lost each time is a byte or more.
  return bytes_after < bytes + static_cast<std::size_t>(times - warm) && lines_after <= lines ? 0 : 1;
}
