/// @file
/// A result that is computed again, by the real program.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/server/support/process.h"
#include "tests/server/support/samples.h"
#include "tests/server/support/temp_dir.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class Recompute : public testing::Test {
 protected:
  void SetUp() override {
    write_file(folder_.file("request.json"), column_request());
    ASSERT_EQ(run({"solve", folder_.file("request.json")}), 0) << err_;
    result_ = json::parse(out_);
  }
  int run(const std::vector<std::string>& arguments) {
    Process process(folder_, arguments, "");
    const int status = process.wait();
    out_ = process.out();
    err_ = process.err();
    return status;
  }
  int compare(const json& result, const std::vector<std::string>& more = {}) {
    write_file(folder_.file("result.json"), result.dump());
    std::vector<std::string> arguments{"recompute", folder_.file("request.json"),
                                       folder_.file("result.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  TempDir folder_;
  json result_;
  std::string out_;
  std::string err_;
};

TEST_F(Recompute, FindsItsOwnResultEqualWhateverMadeIt) {
  result_["program"]["build"] = "another";
  result_["diagnostics"]["wall_time_s"] = 1e3;
  EXPECT_EQ(compare(result_), 0) << err_;
  EXPECT_THAT(out_, HasSubstr(" numbers compared, 0 differ"));
}

TEST_F(Recompute, TellsTheLargestDifferenceAndWhetherItIsTolerated) {
  const double load = result_["summary"]["critical_load_factor"].get<double>();
  result_["summary"]["critical_load_factor"] = load * (1.0 + 1e-6);
  EXPECT_EQ(compare(result_), 3);
  EXPECT_THAT(
      out_,
      HasSubstr("1 differ, the largest relative difference is 9.99999e-07 at /summary/critical_load_factor"));
  EXPECT_EQ(compare(result_, {"--tolerance", "1e-5"}), 0) << err_;
}

TEST_F(Recompute, RefusesTheResultOfAnotherRequestAndOtherForms) {
  json other = result_;
  other["request_sha256"] = std::string(64, '0');
  EXPECT_EQ(compare(other), 2);
  EXPECT_THAT(err_, HasSubstr("of another request"));
  json shorter = result_;
  shorter["critical_points"].erase(0);
  EXPECT_EQ(compare(shorter, {"--tolerance", "1"}), 3);
  EXPECT_THAT(err_, HasSubstr("first at /critical_points"));
  json less = result_;
  less.erase("summary");
  EXPECT_EQ(compare(less), 3);
  EXPECT_THAT(err_, HasSubstr("first at /summary"));
}

}  // namespace
}  // namespace snapthrough::server::test
