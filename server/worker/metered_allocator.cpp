/// @file
/// Stands in front of the allocator: MemoryMeter sees what is allocated and freed. `new` and `delete` are
/// replaced as the language allows; calls of malloc and its relatives in this program's own objects (Eigen's)
/// come to the functions __wrap_* because the linker is told so (--wrap in server/CMakeLists.txt).
/// Allocations inside other libraries' C code are not seen; no analysis makes any.

#include <malloc.h>

#include <cstdlib>
#include <new>

#include "server/worker/memory_meter.h"

using snapthrough::server::MemoryMeter;

extern "C" {
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* pointer, std::size_t size);
void __real_free(void* pointer);
void* __wrap_malloc(std::size_t size);
void* __wrap_calloc(std::size_t count, std::size_t size);
void* __wrap_realloc(void* pointer, std::size_t size);
void __wrap_free(void* pointer);
}

namespace {

std::int64_t size_of(void* pointer) { return static_cast<std::int64_t>(::malloc_usable_size(pointer)); }

/// Calls the allocator if the thread's meter admits it; null otherwise.
template <class Allocate>
void* metered(std::size_t size, Allocate allocate) {
  MemoryMeter* const meter = MemoryMeter::current();
  if (meter == nullptr) {
    return allocate();
  }
  if (!meter->admits(size)) {
    return nullptr;
  }
  void* const pointer = allocate();
  if (pointer != nullptr) {
    meter->add(size_of(pointer));
  }
  return pointer;
}

void metered_free(void* pointer) {
  if (MemoryMeter* const meter = MemoryMeter::current(); meter != nullptr && pointer != nullptr) {
    meter->add(-size_of(pointer));
  }
  __real_free(pointer);
}

template <class Allocate>
void* metered_new(std::size_t size, Allocate allocate) {
  while (true) {
    if (void* const pointer = metered(size, allocate)) {
      return pointer;
    }
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) {
      throw std::bad_alloc();
    }
    handler();
  }
}

}  // namespace

void* __wrap_malloc(std::size_t size) {
  return metered(size, [size] { return __real_malloc(size); });
}

void* __wrap_calloc(std::size_t count, std::size_t size) {
  std::size_t bytes = 0;
  if (__builtin_mul_overflow(count, size, &bytes)) {
    return nullptr;
  }
  return metered(bytes, [count, size] { return __real_calloc(count, size); });
}

void* __wrap_realloc(void* pointer, std::size_t size) {
  MemoryMeter* const meter = MemoryMeter::current();
  if (meter == nullptr) {
    return __real_realloc(pointer, size);
  }
  // The old and the new block may exist at the same time.
  if (!meter->admits(size)) {
    return nullptr;
  }
  const std::int64_t before = pointer == nullptr ? 0 : size_of(pointer);
  void* const moved = __real_realloc(pointer, size);
  if (moved != nullptr) {
    meter->add(size_of(moved) - before);
  }
  return moved;
}

void __wrap_free(void* pointer) { metered_free(pointer); }

void* operator new(std::size_t size) {
  const std::size_t bytes = size == 0 ? 1 : size;
  return metered_new(bytes, [bytes] { return __real_malloc(bytes); });
}

void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  const std::size_t bytes = (size / step + (size % step == 0 && size > 0 ? 0 : 1)) * step;
  return metered_new(bytes, [=] { return std::aligned_alloc(step, bytes); });
}

void operator delete(void* pointer) noexcept { metered_free(pointer); }
void operator delete(void* pointer, std::size_t) noexcept { metered_free(pointer); }
void operator delete(void* pointer, std::align_val_t) noexcept { metered_free(pointer); }
void operator delete(void* pointer, std::size_t, std::align_val_t) noexcept { metered_free(pointer); }
