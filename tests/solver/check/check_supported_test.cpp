/// What the contract allows and this version refuses: each feature is refused where it is used. A feature
/// that is implemented moves from here to the tests of what it does.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "solver/check/check.h"
#include "tests/solver/check/sound_model.h"

namespace snapthrough {
namespace {

struct Case {
  const char* name;
  void (*use)(Model& m, Analysis& a);
  const char* pointer;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class NotSupportedYet : public ::testing::TestWithParam<Case> {};

TEST_P(NotSupportedYet, IsRefusedWhereItIsUsed) {
  auto [model, analysis] = testing::sound_request();
  GetParam().use(model, analysis);
  const auto findings = check(model, analysis);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].pointer, GetParam().pointer);
  EXPECT_EQ(findings[0].code, "unsupported");
}

#define USE(...) []([[maybe_unused]] Model& m, [[maybe_unused]] Analysis& a) { __VA_ARGS__; }

const Case kCases[] = {
    {"LinearPath", USE(a.geometry = Geometry::linear), "/analysis/geometry"},
};
INSTANTIATE_TEST_SUITE_P(Contract, NotSupportedYet, ::testing::ValuesIn(kCases),
                         [](const auto& param_info) { return std::string(param_info.param.name); });

}  // namespace
}  // namespace snapthrough
