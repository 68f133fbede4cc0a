#pragma once
/// @file
/// How tests look at findings: a matcher by place and rule, and failures that can be read.

#include <gmock/gmock.h>

#include <ostream>
#include <string>

#include "solver/check/check.h"

namespace snapthrough {

inline void PrintTo(const Finding& finding, std::ostream* out) {
  *out << finding.pointer << " [" << finding.code << "] " << finding.detail;
}

namespace testing {

inline auto is_finding(const std::string& pointer, const std::string& code) {
  return ::testing::AllOf(::testing::Field("pointer", &Finding::pointer, pointer),
                          ::testing::Field("code", &Finding::code, code));
}

}  // namespace testing
}  // namespace snapthrough
