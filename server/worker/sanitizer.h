#pragma once
/// @file
/// SNAPTHROUGH_SANITIZED is 1 in a build with AddressSanitizer or ThreadSanitizer, and 0 in any other. These
/// sanitizers reserve terabytes of addresses, replace malloc and make system calls of their own.

// GCC defines a macro for each sanitizer; Clang defines none, but answers __has_feature.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SNAPTHROUGH_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SNAPTHROUGH_SANITIZED 1
#endif
#endif
#ifndef SNAPTHROUGH_SANITIZED
#define SNAPTHROUGH_SANITIZED 0
#endif
