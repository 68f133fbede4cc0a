/// @file
/// The page as a browser is given it.

#include "server/resources/page.h"

#include <gmock/gmock.h>
#include <zlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>

#include "server/digest.h"
#include "tests/server/support/running_service.h"

namespace snapthrough::server::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string gunzipped(const std::string& packed) {
  z_stream stream{};
  EXPECT_EQ(::inflateInit2(&stream, 15 + 16), Z_OK);
  std::string text(20 * packed.size() + 1000, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));  // zlib does not write to it
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  EXPECT_EQ(::inflate(&stream, Z_FINISH), Z_STREAM_END);
  text.resize(stream.total_out);
  ::inflateEnd(&stream);
  return text;
}

bool has_tables_of_fields(std::string_view path) {
  const std::vector<http::FieldsDocument>& all = http::fields_documents();
  return std::any_of(all.begin(), all.end(),
                     [&](const http::FieldsDocument& one) { return one.path == path; });
}

class PageTest : public ServiceTest {
 protected:
  void serve(const std::string& web, std::vector<http::ApiKey> keys = {}) {
    ServiceConfig with_page = config();
    with_page.web = web;
    with_page.keys = std::move(keys);
    ASSERT_TRUE(with_page.check().empty()) << with_page.check().front().detail;
    service_ = std::make_unique<Service>(with_page, Environment::system(),
                                         local_runners([](auto&&...) { return Result(); }), log_);
    ASSERT_TRUE(service_->start().ok());
  }
  void serve_built_in() { serve(std::string(http::kEmbeddedPage)); }
  /// The address of the script that the page begins with.
  [[nodiscard]] std::string script() const {
    const std::string index = get(port(), "/").body;
    std::smatch found;
    return std::regex_search(index, found, std::regex("/assets/app-[A-Z0-9]+\\.js")) ? found.str() : "";
  }
};

TEST_F(PageTest, TheIndexMayOnlyUseWhatTheServiceGives) {
  serve_built_in();
  const Reply reply = get(port(), "/");
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.header("Content-Type"), "text/html; charset=utf-8");
  EXPECT_THAT(reply.body, StartsWith("<!doctype html>"));
  const std::string policy = reply.header("Content-Security-Policy");
  EXPECT_THAT(policy, StartsWith("default-src 'self';"));
  EXPECT_THAT(policy, HasSubstr("frame-ancestors 'none'"));
  EXPECT_THAT(policy, Not(HasSubstr("unsafe")));
  EXPECT_EQ(reply.header("X-Content-Type-Options"), "nosniff");
  EXPECT_EQ(reply.header("Cache-Control"), "no-cache");
  EXPECT_THAT(reply.body, Not(HasSubstr("style="))) << "the policy would refuse it";
  EXPECT_FALSE(std::regex_search(reply.body, std::regex("<script[^>]*>[^<]"))) << "a script inside the page";
}

TEST_F(PageTest, EveryFileHasTheDigestOfItsContent) {
  serve_built_in();
  ASSERT_GE(http::embedded_page().size(), 4U);
  for (const http::PageFile& file : http::embedded_page()) {
    if (has_tables_of_fields(file.path)) {
      continue;
    }
    const Reply plain = get(port(), std::string(file.path));
    EXPECT_EQ(plain.status, 200) << file.path;
    EXPECT_EQ(sha256_hex(plain.body), file.digest) << file.path;
    EXPECT_EQ(plain.header("ETag"), "\"" + std::string(file.digest) + "\"");
    EXPECT_EQ(plain.header("Content-Encoding"), "");
    const Reply packed = get(port(), std::string(file.path), {"Accept-Encoding: br, gzip"});
    EXPECT_EQ(packed.header("Content-Encoding"), "gzip");
    EXPECT_EQ(packed.header("ETag"), "\"" + std::string(file.digest) + "-gzip\"");
    EXPECT_EQ(packed.header("Vary"), "Accept-Encoding");
    EXPECT_EQ(packed.body.size(), file.packed.size()) << "packed once";
    EXPECT_EQ(gunzipped(packed.body), plain.body) << file.path;
  }
}

TEST_F(PageTest, AnAssetIsKeptForAYearAndTheIndexAskedForEachTime) {
  serve_built_in();
  const std::string path = script();
  ASSERT_FALSE(path.empty());
  const Reply reply = get(port(), path);
  EXPECT_EQ(reply.header("Content-Type"), "text/javascript; charset=utf-8");
  EXPECT_EQ(reply.header("Cache-Control"), "public, max-age=31536000, immutable");
  for (const std::string& at : {std::string("/"), path}) {
    const std::string etag = get(port(), at, {"Accept-Encoding: gzip"}).header("ETag");
    const Reply known = get(port(), at, {"Accept-Encoding: gzip", "If-None-Match: " + etag});
    EXPECT_EQ(known.status, 304) << at;
    EXPECT_TRUE(known.body.empty());
    EXPECT_FALSE(known.header("Cache-Control").empty());
    EXPECT_EQ(get(port(), at, {"If-None-Match: \"other\""}).status, 200);
  }
}

TEST_F(PageTest, AHeadHasNoBodyAndOtherMethodsAreNotAllowed) {
  serve_built_in();
  Socket socket(port());
  socket.send("HEAD / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  const Reply head = socket.receive(true);
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.header("Content-Length"), std::to_string(get(port(), "/").body.size()));
  EXPECT_TRUE(socket.rest().empty());
  const Reply posted = post(port(), "/", "{}");
  EXPECT_EQ(posted.status, 405);
  EXPECT_EQ(posted.header("Allow"), "GET, HEAD");
}

TEST_F(PageTest, WithoutAPageItsPathsHaveNothing) {
  serve(std::string(http::kNoPage));
  EXPECT_EQ(get(port(), "/").status, 404);
  EXPECT_EQ(get(port(), std::string(http::embedded_page().back().path)).status, 404);
  EXPECT_EQ(get(port(), "/docs/theory.md").status, 404);
  EXPECT_EQ(get(port(), "/livez").status, 200);
}

TEST_F(PageTest, ThePageNeedsNoKeyAndTellsNothingThatNeedsOne) {
  serve(std::string(http::kEmbeddedPage), {{"ann", sha256_hex("key of ann")}});
  EXPECT_EQ(get(port(), "/").status, 200);
  EXPECT_EQ(get(port(), script()).status, 200);
  EXPECT_EQ(get(port(), "/assets/none.js").status, 404);
  EXPECT_EQ(get(port(), "/v1/jobs").status, 401);
  EXPECT_EQ(get(port(), "/v1/examples").status, 401);
  EXPECT_EQ(get(port(), "/assetsx").status, 401);
}

TEST_F(PageTest, TheDocumentsComeWithIt) {
  serve(std::string(http::kEmbeddedPage), {{"ann", sha256_hex("key of ann")}});
  const Reply document = get(port(), "/docs/theory.md");
  EXPECT_EQ(document.status, 200);
  EXPECT_EQ(document.header("Content-Type"), "text/markdown; charset=utf-8");
  EXPECT_EQ(document.header("Cache-Control"), "no-cache");
  EXPECT_THAT(document.body, StartsWith("# Theory"));
  EXPECT_EQ(get(port(), "/docs/thesis/figure_4_2.svg").header("Content-Type"), "image/svg+xml");
  const Reply docs = get(port(), "/docs");
  EXPECT_EQ(docs.status, 302);
  EXPECT_EQ(docs.header("Location"), "/#/docs/interface");
  for (const char* path : {"/docs/", "/docs/none.md", "/docs/page/README.md", "/docs/../README.md"}) {
    EXPECT_THAT(get(port(), path).status, testing::AnyOf(401, 404)) << path;
  }
}

TEST_F(PageTest, EachExampleOfTheInterfaceIsTaken) {
  serve_built_in();
  int examples = 0;
  const nlohmann::json interface = nlohmann::json::parse(get(port(), "/v1/openapi.json").body);
  for (const auto& [path, operations] : interface["paths"].items()) {
    const nlohmann::json::json_pointer place("/post/requestBody/content/application~1json/example");
    if (operations.contains(place)) {
      ++examples;
      EXPECT_THAT(post(port(), path, operations[place].dump()).status, testing::AnyOf(200, 201)) << path;
    }
  }
  EXPECT_EQ(examples, 5) << "jobs, sweeps, the check, files and figures";
}

TEST_F(PageTest, RequestsAndResultsHaveTheirTablesOfFields) {
  serve_built_in();
  ASSERT_EQ(http::fields_documents().size(), 2U);
  for (const char* path : {"/docs/requests.md", "/docs/results.md"}) {
    EXPECT_TRUE(has_tables_of_fields(path));
    const Reply plain = get(port(), path);
    EXPECT_EQ(plain.header("ETag"), "\"" + sha256_hex(plain.body) + "\"");
    EXPECT_THAT(plain.body, HasSubstr("\n| field | values | unit | what |\n"));
    const Reply packed = get(port(), path, {"Accept-Encoding: gzip"});
    EXPECT_EQ(gunzipped(packed.body), plain.body);
    EXPECT_EQ(get(port(), path, {"Accept-Encoding: gzip", "If-None-Match: " + packed.header("ETag")}).status,
              304);
  }
}

TEST_F(PageTest, AFolderIsReadAtEveryRequestAndNeverLeft) {
  const std::filesystem::path web = folder_.file("web");
  std::filesystem::create_directories(web / "assets");
  std::ofstream(web / "index.html") << "<!doctype html>one";
  std::ofstream(web / "assets/a.css") << "p{}";
  std::ofstream(web / "secret") << "secret";
  serve(web.string());
  const Reply first = get(port(), "/");
  EXPECT_EQ(first.body, "<!doctype html>one");
  EXPECT_EQ(get(port(), "/", {"If-None-Match: " + first.header("ETag")}).status, 304);
  std::ofstream(web / "index.html") << "<!doctype html>two";
  EXPECT_EQ(get(port(), "/", {"If-None-Match: " + first.header("ETag")}).body, "<!doctype html>two");
  EXPECT_EQ(get(port(), "/assets/a.css").header("Content-Type"), "text/css; charset=utf-8");
  for (const char* path : {"/assets/../secret", "/assets/..%2Fsecret", "/assets/%2e%2e/secret", "/assets/",
                           "/assets/.", "/assets/..", "/assets//secret", "/assets/a.css/x"}) {
    EXPECT_EQ(get(port(), path).status, 404) << path;
  }
}

TEST(PageSetting, AFolderWithoutAnIndexIsRefused) {
  ServiceConfig config = ServiceConfig::defaults();
  EXPECT_TRUE(config.check().empty());
  config.web = "/nowhere";
  ASSERT_EQ(config.check().size(), 1U);
  EXPECT_EQ(config.check().front().field, "web");
}

}  // namespace
}  // namespace snapthrough::server::test
