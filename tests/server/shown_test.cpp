/// @file
/// Texts of others on a terminal.

#include "server/cli/shown.h"

#include <gmock/gmock.h>

#include <sstream>

#include "server/cli/app.h"
#include "server/cli/streams.h"
#include "tests/server/support/samples.h"
#include "tests/server/support/temp_dir.h"

namespace snapthrough::server::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Shown, ControlCharactersAreCodesAndOthersStay) {
  EXPECT_EQ(shown("a\tb\nc \"\\ \xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80 \xc2\xa0"),
            "a\tb\nc \"\\ \xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80 \xc2\xa0");
  EXPECT_EQ(shown("\x1b[31m\r\a\b\x7f"), "\\u001b[31m\\u000d\\u0007\\u0008\\u007f");
  EXPECT_EQ(shown(std::string_view("\0\x1f", 2)), "\\u0000\\u001f");
  EXPECT_EQ(shown("\xc2\x9b\x31m \xc2\x80 \xc2\x9f"), "\\u009b1m \\u0080 \\u009f");
  EXPECT_EQ(shown(""), "");
}

TEST(Shown, BytesThatAreNoUtf8AreCodes) {
  EXPECT_EQ(shown("\x9b"), "\\u009b");
  EXPECT_EQ(shown("\xc2"), "\\u00c2");
  EXPECT_EQ(shown("\xc2x"), "\\u00c2x");
  EXPECT_EQ(shown("\xe0\x82\x9b"), "\\u00e0\\u0082\\u009b") << "a longer form of U+009b";
  EXPECT_EQ(shown("\xc1\x9b\xf5\xff"), "\\u00c1\\u009b\\u00f5\\u00ff");
}

TEST(ShownStream, CharactersMayComeInPiecesAndOwnCommandsPass) {
  std::ostringstream to;
  ShownStream stream(to);
  stream << '\xc3' << '\xa9' << '\xc2' << '\x9b' << line_start << "\r" << line_end << "\xe2\x82";
  EXPECT_EQ(to.str(), "\xc3\xa9\\u009b\r\\u000d\x1b[K");
  stream << std::flush;
  EXPECT_EQ(to.str(), "\xc3\xa9\\u009b\r\\u000d\x1b[K\\u00e2\\u0082");
  std::ostringstream plain;
  plain << line_start << "a" << line_end;
  EXPECT_EQ(plain.str(), "\ra\x1b[K");
}

TEST(ShownStream, MessagesAboutDocumentsDoNotCommandTheTerminal) {
  const test::TempDir folder;
  std::string text = test::column_request();
  text.insert(1, "\"\\u001b[2J\\u009b\": 1, ");
  std::istringstream in(text);
  std::ostringstream out;
  std::ostringstream err;
  const char* const check[] = {"snapthrough", "check", "-"};
  EXPECT_EQ(run(3, check, {in, out, err}), kWrongRequest);
  EXPECT_THAT(err.str(), HasSubstr("\\u001b[2J\\u009b"));
  const std::string file = folder.file("\x1b]0;x\a");
  const char* const missing[] = {"snapthrough", "solve", file.c_str()};
  EXPECT_EQ(run(3, missing, {in, out, err}), kOther);
  EXPECT_THAT(err.str() + out.str(), Not(HasSubstr("\x1b")));
}

}  // namespace
}  // namespace snapthrough::server::cli
