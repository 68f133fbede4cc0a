#pragma once
/// @file
/// Figures of a passing test go into its report (--gtest_output=json:FILE), not to standard output.
/// scripts/lib/recorded.py prints them.

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace snapthrough {

/// @brief Records something under a name of the running test.
/// @param key letters, digits and underscores; the last value under a name stands
/// @param parts written one after the other
template <typename... Parts>
void record_figure(const std::string& key, const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  ::testing::Test::RecordProperty(key, text.str());
}

}  // namespace snapthrough
