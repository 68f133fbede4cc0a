/// Binds functions whose versions are new to those that every glibc since 2.17 has. The linker sends
/// calls of NAME to __wrap_NAME. The older versions of the mathematical functions compute the same; they also set errno.
#if defined(__aarch64__)
#define OLDEST "GLIBC_2.17"
#else
#define OLDEST "GLIBC_2.2.5"
#endif
#define BIND(name) __asm__(".symver old_" #name ", " #name "@" OLDEST)

// NOLINTBEGIN(bugprone-reserved-identifier, readability-identifier-naming): the linker and glibc give these names
extern "C" {

/// Read by the C++ library, which then counts references with atomic instructions as beside other threads.
char __libc_single_threaded = 0;

double old_hypot(double x, double y);
double old_exp(double x);
double old_log(double x);
double old_pow(double x, double y);
int old_pthread_once(int* once, void (*function)());
int old___pthread_key_create(unsigned* key, void (*destroy)(void*));
BIND(hypot);
BIND(exp);
BIND(log);
BIND(pow);
BIND(pthread_once);
BIND(__pthread_key_create);

double __wrap_hypot(double x, double y) { return old_hypot(x, y); }
double __wrap_exp(double x) { return old_exp(x); }
double __wrap_log(double x) { return old_log(x); }
double __wrap_pow(double x, double y) { return old_pow(x, y); }
int __wrap_pthread_once(int* once, void (*function)()) { return old_pthread_once(once, function); }
int __wrap___pthread_key_create(unsigned* key, void (*destroy)(void*)) { return old___pthread_key_create(key, destroy); }
}
// NOLINTEND(bugprone-reserved-identifier, readability-identifier-naming)
