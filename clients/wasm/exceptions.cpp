/// @file
/// Throw and catch for WebAssembly. Debian's libc++abi for wasm32 is built without exceptions; this is what it
/// lacks: allocation, throw, catch and rethrow, and the choice of a handler.
///
/// Sources: Itanium C++ ABI, Exception Handling, level II (itanium-cxx-abi.github.io/cxx-abi/abi-eh.html); its
/// table of handlers with the call sites numbered, as LLVM writes it for WebAssembly; the WebAssembly proposal
/// for exception handling. One thread, no foreign exceptions, no dynamic exception specifications.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <typeinfo>

namespace __cxxabiv1 {

/// The part of libc++abi's type descriptions that chooses handlers.
class __shim_type_info : public std::type_info {
 public:
  ~__shim_type_info() override;
  virtual void noop1() const;
  virtual void noop2() const;
  /// Whether a handler of this type takes an object of the thrown type; then adjusts the object's address.
  virtual bool can_catch(const __shim_type_info* thrown, void*& object) const = 0;
};

}  // namespace __cxxabiv1

namespace {

using Type = __cxxabiv1::__shim_type_info;
using Destructor = void* (*)(void*);

struct Thrown;

/// A throw, from its begin until its last handler has ended. Its address is what WebAssembly throws.
struct Flight {
  Thrown* thrown = nullptr;
  void* object = nullptr;  ///< address of the object, adjusted for the handler
  int handlers = 0;        ///< handlers that have not ended; negative: it is thrown again
  Flight* below = nullptr;  ///< in the stack of what is caught
};

/// In front of each thrown object.
struct alignas(std::max_align_t) Thrown {
  std::size_t references = 0;
  const std::type_info* type = nullptr;
  Destructor destroy = nullptr;
  Flight first;

  void* object() { return this + 1; }
  static Thrown* of(void* object) { return static_cast<Thrown*>(object) - 1; }
};

Flight* caught = nullptr;  // the innermost handler's first
unsigned uncaught = 0;

/// Memory for one small exception, such as std::bad_alloc, where malloc() has none.
struct alignas(std::max_align_t) {
  std::byte bytes[256];
  bool is_used = false;
} reserve;

[[noreturn]] void launch(Flight& flight) {
  ++uncaught;
  __builtin_wasm_throw(0, &flight);
}

void release(Thrown* thrown) {
  if (--thrown->references > 0) return;
  if (thrown->destroy != nullptr) thrown->destroy(thrown->object());
  if (static_cast<void*>(thrown) == reserve.bytes)
    reserve.is_used = false;
  else
    std::free(thrown);
}

/// Removes the innermost caught flight; `ended`: its last handler has ended, too.
void pop(bool ended) {
  Flight* const flight = caught;
  caught = flight->below;
  if (!ended) return;
  Thrown* const thrown = flight->thrown;
  if (flight != &thrown->first) delete flight;
  release(thrown);
}

/// Numbers of the LEB128 format.
class Reader {
 public:
  explicit Reader(const std::uint8_t* at) : at_(at) {}
  std::uint8_t byte() { return *at_++; }
  std::uintptr_t number() {
    std::uintptr_t value = 0;
    unsigned shift = 0;
    std::uint8_t part = 0;
    do {
      part = byte();
      value |= static_cast<std::uintptr_t>(part & 0x7F) << shift;
      shift += 7;
    } while ((part & 0x80) != 0);
    last_ = part;
    shift_ = shift;
    return value;
  }
  std::intptr_t signed_number() {
    std::uintptr_t value = number();
    constexpr unsigned kBits = 8 * sizeof(value);
    if ((last_ & 0x40) != 0 && shift_ < kBits) value |= ~std::uintptr_t{0} << shift_;
    return static_cast<std::intptr_t>(value);
  }
  [[nodiscard]] const std::uint8_t* at() const { return at_; }

 private:
  const std::uint8_t* at_;
  std::uint8_t last_ = 0;
  unsigned shift_ = 0;
};

constexpr std::uint8_t kOmitted = 0xFF;  // DW_EH_PE_omit

/// Table of a function: for each call that may throw, its handlers' types.
struct Handlers {
  const std::uint8_t* types = nullptr;    ///< end of the list of types
  const std::uint8_t* actions = nullptr;  ///< begin of the list of actions
  std::uintptr_t action = 0;              ///< of the call, counted from 1; 0: it has no handlers

  Handlers(const std::uint8_t* table, std::uintptr_t call) {
    Reader reader(table);
    if (reader.byte() != kOmitted) std::terminate();  // a base of landing pads, which WebAssembly does not have
    if (reader.byte() != kOmitted) {
      const std::uintptr_t size = reader.number();
      types = reader.at() + size;
    }
    reader.byte();  // the format of the table of calls: numbers
    const std::uintptr_t size = reader.number();
    actions = reader.at() + size;
    for (std::uintptr_t i = 0; reader.at() < actions; ++i) {
      reader.number();  // the landing pad
      const std::uintptr_t found = reader.number();
      if (i == call) {
        action = found;
        return;
      }
    }
  }
  /// Type number `index`, counted from 1 backwards; null: every exception.
  [[nodiscard]] const Type* type(std::intptr_t index) const {
    const Type* out = nullptr;
    std::memcpy(&out, types - static_cast<std::size_t>(index) * sizeof(out), sizeof(out));
    return out;
  }
};

/// Returns the number of the first handler type that takes the thrown object, and sets `Flight::object` to the
/// address that this handler gets; 0: no handler takes it.
std::uintptr_t choose(const Handlers& handlers, Flight& flight) {
  const std::uint8_t* at = handlers.action == 0 ? nullptr : handlers.actions + handlers.action - 1;
  while (at != nullptr) {
    Reader reader(at);
    const std::intptr_t index = reader.signed_number();
    const std::uint8_t* const here = reader.at();
    const std::intptr_t next = reader.signed_number();
    if (index < 0) std::terminate();  // a dynamic exception specification
    if (index > 0) {
      const Type* const type = handlers.type(index);
      void* object = flight.thrown->object();
      if (type == nullptr || type->can_catch(static_cast<const Type*>(flight.thrown->type), object)) {
        flight.object = object;
        return static_cast<std::uintptr_t>(index);
      }
    }
    at = next == 0 ? nullptr : here + next;
  }
  return 0;
}

}  // namespace

extern "C" {

/// What a landing pad and the choice of its handler tell each other; the compiler knows its layout.
struct LandingPadContext {
  std::uintptr_t call = 0;
  const std::uint8_t* table = nullptr;
  std::uintptr_t selector = 0;
};
thread_local LandingPadContext __wasm_lpad_context;

/// Chooses the handler of a landing pad.
int _Unwind_CallPersonality(void* payload) {
  LandingPadContext& pad = __wasm_lpad_context;
  pad.selector = 0;
  if (pad.table != nullptr)
    pad.selector = choose(Handlers(pad.table, pad.call), *static_cast<Flight*>(payload));
  return 0;
}
void __gxx_wasm_personality_v0() { std::terminate(); }  // functions name it, nothing calls it

void* __cxa_allocate_exception(std::size_t size) noexcept {
  const std::size_t all = sizeof(Thrown) + size;
  void* memory = std::malloc(all);
  if (memory == nullptr && !reserve.is_used && all <= sizeof reserve.bytes) {
    reserve.is_used = true;
    memory = reserve.bytes;
  }
  if (memory == nullptr) std::terminate();
  return (new (memory) Thrown)->object();
}
void __cxa_free_exception(void* object) noexcept {
  Thrown* const thrown = Thrown::of(object);
  thrown->references = 1;
  thrown->destroy = nullptr;
  release(thrown);
}
[[noreturn]] void __cxa_throw(void* object, std::type_info* type, Destructor destroy) {
  Thrown* const thrown = Thrown::of(object);
  thrown->references = 1;
  thrown->type = type;
  thrown->destroy = destroy;
  thrown->first = {thrown, object, 0, nullptr};
  launch(thrown->first);
}

void* __cxa_get_exception_ptr(void* payload) noexcept { return static_cast<Flight*>(payload)->object; }
void* __cxa_begin_catch(void* payload) noexcept {
  auto* const flight = static_cast<Flight*>(payload);
  flight->handlers = std::abs(flight->handlers) + 1;
  if (flight != caught) {
    flight->below = caught;
    caught = flight;
  }
  --uncaught;
  return flight->object;
}
void __cxa_end_catch() {
  if (caught == nullptr) return;
  if (caught->handlers < 0) {
    if (++caught->handlers == 0) pop(false);
  } else if (--caught->handlers == 0) {
    pop(true);
  }
}
[[noreturn]] void __cxa_rethrow() {
  if (caught == nullptr) std::terminate();
  caught->handlers = -caught->handlers;
  launch(*caught);
}

std::type_info* __cxa_current_exception_type() {
  return caught == nullptr ? nullptr : const_cast<std::type_info*>(caught->thrown->type);
}
bool __cxa_uncaught_exception() noexcept { return uncaught != 0; }
unsigned __cxa_uncaught_exceptions() noexcept { return uncaught; }

// libc++ calls these for std::exception_ptr, which keeps a thrown object alive
void* __cxa_current_primary_exception() noexcept {
  if (caught == nullptr) return nullptr;
  ++caught->thrown->references;
  return caught->thrown->object();
}
void __cxa_increment_exception_refcount(void* object) noexcept {
  if (object != nullptr) ++Thrown::of(object)->references;
}
void __cxa_decrement_exception_refcount(void* object) noexcept {
  if (object != nullptr) release(Thrown::of(object));
}
void __cxa_rethrow_primary_exception(void* object) {
  if (object == nullptr) return;
  Thrown* const thrown = Thrown::of(object);
  ++thrown->references;
  launch(*new Flight{thrown, object, 0, nullptr});
}

[[noreturn]] void __cxa_bad_cast() { throw std::bad_cast(); }
[[noreturn]] void __cxa_bad_typeid() { throw std::bad_typeid(); }
[[noreturn]] void __cxa_throw_bad_array_new_length() { throw std::bad_array_new_length(); }
}

// Those of libc++ end the module where there is no memory.
void* operator new(std::size_t size) {
  for (;;) {
    if (void* const memory = std::malloc(size == 0 ? 1 : size)) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto align = static_cast<std::size_t>(alignment);
  const std::size_t rounded = (size + align - 1) / align * align;
  if (void* const memory = std::aligned_alloc(align, rounded == 0 ? align : rounded)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return std::malloc(size == 0 ? 1 : size); }
void* operator new[](std::size_t size) { return ::operator new(size); }
void* operator new[](std::size_t size, std::align_val_t alignment) { return ::operator new(size, alignment); }
void* operator new[](std::size_t size, const std::nothrow_t& tag) noexcept { return ::operator new(size, tag); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
