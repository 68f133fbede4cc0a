/// @file
/// Stands in front of the allocator: MemoryMeter sees what is allocated and freed. `new` and `delete` are
/// replaced as the language allows; calls of malloc and its relatives in this program's own objects (Eigen's)
/// come to the functions __wrap_* because the linker is told so (--wrap in server/CMakeLists.txt).
/// Allocations inside other libraries' C code are not seen; no analysis makes any.

#include <malloc.h>

#include <algorithm>
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

/// As the standard has it: the handler is asked for more room until there is none.
template <class Allocate>
void* new_with(std::size_t size, Allocate allocate) {
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

void* metered_new(std::size_t size) {
  const std::size_t bytes = size == 0 ? 1 : size;
  return new_with(bytes, [bytes] { return __real_malloc(bytes); });
}

void* metered_new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  const std::size_t bytes = size == 0 ? step : size;
  return new_with(bytes, [=] {
    void* pointer = nullptr;
    return ::posix_memalign(&pointer, std::max(step, sizeof(void*)), bytes) == 0 ? pointer : nullptr;
  });
}

template <class Allocate>
void* or_null(Allocate allocate) noexcept {
  try {
    return allocate();
  } catch (const std::bad_alloc&) {
    return nullptr;
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

// Every form is here: a sanitizer brings its own of those that are not, and they don't mix.
void* operator new(std::size_t size) { return metered_new(size); }
void* operator new[](std::size_t size) { return metered_new(size); }
void* operator new(std::size_t size, std::align_val_t alignment) { return metered_new(size, alignment); }
void* operator new[](std::size_t size, std::align_val_t alignment) { return metered_new(size, alignment); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return or_null([=] { return metered_new(size); });
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return or_null([=] { return metered_new(size); });
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return or_null([=] { return metered_new(size, alignment); });
}
void* operator new[](std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return or_null([=] { return metered_new(size, alignment); });
}

void operator delete(void* pointer) noexcept { metered_free(pointer); }
void operator delete[](void* pointer) noexcept { metered_free(pointer); }
void operator delete(void* pointer, std::size_t) noexcept { metered_free(pointer); }
void operator delete[](void* pointer, std::size_t) noexcept { metered_free(pointer); }
void operator delete(void* pointer, std::align_val_t) noexcept { metered_free(pointer); }
void operator delete[](void* pointer, std::align_val_t) noexcept { metered_free(pointer); }
void operator delete(void* pointer, std::size_t, std::align_val_t) noexcept { metered_free(pointer); }
void operator delete[](void* pointer, std::size_t, std::align_val_t) noexcept { metered_free(pointer); }
void operator delete(void* pointer, const std::nothrow_t&) noexcept { metered_free(pointer); }
void operator delete[](void* pointer, const std::nothrow_t&) noexcept { metered_free(pointer); }
void operator delete(void* pointer, std::align_val_t, const std::nothrow_t&) noexcept {
  metered_free(pointer);
}
void operator delete[](void* pointer, std::align_val_t, const std::nothrow_t&) noexcept {
  metered_free(pointer);
}
