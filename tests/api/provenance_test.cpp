/// @file
/// What made an answer: digests by standards, with values from outside.

#include "api/provenance.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "api/api.h"
#include "api/sha256.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;

/// Examples of FIPS 180-4 and of NIST's "SHA-256" examples, and lengths about a block's end, whose digests
/// come from coreutils' sha256sum.
TEST(Sha256, GivesThePublishedDigests) {
  EXPECT_EQ(sha256_digest(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_digest("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_digest(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_EQ(sha256_digest(std::string(55, 'x')),
            "d5e285683cd4efc02d021a5c62014694958901005d6f71e89e0989fac77e4072");
  EXPECT_EQ(sha256_digest(std::string(56, 'x')),
            "04c26261370ee7541549d16dee320c723e3fd14671e66a099afe0a377c16888e");
  EXPECT_EQ(sha256_digest(std::string(64, 'x')),
            "7ce100971f64e7001e8fe5a51973ecdfe1ced42befe7ee8d5fd6219506b5393c");
}

/// The number samples of RFC 8785, Appendix B, as values of double.
TEST(CanonicalText, WritesNumbersAsEcmaScript) {
  const auto text = [](double number) { return canonical_text(json(number)); };
  EXPECT_EQ(text(0.0), "0");
  EXPECT_EQ(text(-0.0), "0");
  EXPECT_EQ(text(5e-324), "5e-324");
  EXPECT_EQ(text(-5e-324), "-5e-324");
  EXPECT_EQ(text(1.7976931348623157e308), "1.7976931348623157e+308");
  EXPECT_EQ(text(9007199254740992.0), "9007199254740992");
  EXPECT_EQ(text(295147905179352830000.0), "295147905179352830000");
  EXPECT_EQ(text(9.999999999999997e22), "9.999999999999997e+22");
  EXPECT_EQ(text(1e23), "1e+23");
  EXPECT_EQ(text(999999999999999700000.0), "999999999999999700000");
  EXPECT_EQ(text(1e21), "1e+21");
  EXPECT_EQ(text(9.999999999999997e-7), "9.999999999999997e-7");
  EXPECT_EQ(text(0.000001), "0.000001");
  EXPECT_EQ(text(333333333.3333332), "333333333.3333332");
  EXPECT_EQ(text(-0.0000033333333333333333), "-0.0000033333333333333333");
  EXPECT_EQ(text(1424953923781206.2), "1424953923781206.2");
}

/// The sample of RFC 8785, section 3.2.2 to 3.2.4.
TEST(CanonicalText, SortsMembersAndEscapesAsTheSchemeSays) {
  const json document = json::parse(R"({
    "numbers": [333333333.33333329, 1E30, 4.50, 2e-3, 0.000000000000000000000000001],
    "string": "\u20ac$\u000F\u000aA'\u0042\u0022\u005c\\\"\/",
    "literals": [null, true, false]})");
  EXPECT_EQ(canonical_text(document),
            "{\"literals\":[null,true,false],\"numbers\":[333333333.3333333,1e+30,4.5,0.002,1e-27],"
            "\"string\":\"\xe2\x82\xac$\\u000f\\nA'B\\\"\\\\\\\\\\\"/\"}");
}

TEST(RequestDigest, IsOfTheContentAndNotOfTheSpelling) {
  const std::string one = request_digest(json::parse(R"({"a": 1, "b": [1.50, {}]})"));
  EXPECT_EQ(one, request_digest(json::parse(R"({"b":[15e-1,{ }],"a":1.0})")));
  EXPECT_NE(one, request_digest(json::parse(R"({"b":[1.51,{}],"a":1.0})")));
  EXPECT_EQ(one, sha256_digest(R"({"a":1,"b":[1.5,{}]})"));
}

TEST(ThisProgram, SaysWhatItIs) {
  const json program = program_json();
  EXPECT_EQ(program["name"], "snapthrough");
  EXPECT_EQ(program.size(), 4u);
  for (const auto& [name, value] : program.items()) {
    EXPECT_FALSE(value.get<std::string>().empty()) << name;
  }
  EXPECT_EQ(json::parse("{" + provenance_members("table", program_text(), "abc") + "}"),
            (json{{"kind", "table"}, {"program", program}, {"request_sha256", "abc"}}));
  EXPECT_EQ(json::parse("{" + provenance_members("table", "", "") + "}"),
            (json{{"kind", "table"}, {"program", nullptr}, {"request_sha256", nullptr}}));
}

}  // namespace
}  // namespace snapthrough::api
