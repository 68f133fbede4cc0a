#include "server/front/request_head.h"

#include <gtest/gtest.h>

namespace snapthrough::server::http {
namespace {

/// With a Host where there is none.
Head head_of(const std::string& lines, const HeadLimits& limits = {}) {
  const std::string host = lines.find("Host:") == std::string::npos ? "Host: a\r\n" : "";
  return read_head(lines + host + "\r\n", limits);
}
int refusal(const std::string& lines, const HeadLimits& limits = {}) {
  const Head head = head_of(lines, limits);
  return head.refusal ? head.refusal->status : 0;
}

TEST(RequestHead, ReadsWhatFollowsTheHead) {
  const Head head =
      head_of("POST /v1/jobs?x=1 HTTP/1.1\r\nHost: a\r\ncontent-LENGTH:  12 \r\nExpect: 100-Continue\r\n");
  EXPECT_FALSE(head.refusal.has_value());
  EXPECT_EQ(head.method, "POST");
  EXPECT_EQ(head.target, "/v1/jobs?x=1");
  EXPECT_EQ(head.body_bytes, 12U);
  EXPECT_TRUE(head.expects_continue);
}

TEST(RequestHead, ARequestWithoutBodyNeedsNoLength) {
  EXPECT_EQ(refusal("GET / HTTP/1.1\r\n"), 0);
  EXPECT_EQ(head_of("GET / HTTP/1.1\r\n").body_bytes, 0U);
}

TEST(RequestHead, ARequestOfHttp11NeedsAHost) {
  EXPECT_EQ(read_head("GET / HTTP/1.1\r\n\r\n", {}).refusal->status, 400);
  EXPECT_FALSE(read_head("GET / HTTP/1.0\r\n\r\n", {}).refusal);
}

TEST(RequestHead, ATargetMayNameSchemeAndHost) {
  EXPECT_EQ(head_of("GET http://a:1/v1/jobs?x=1 HTTP/1.1\r\n").target, "/v1/jobs?x=1");
  EXPECT_EQ(head_of("GET HTTP://a HTTP/1.1\r\n").target, "/");
}

TEST(RequestHead, HeadersAreReadInOrderAsTheyCame) {
  const Head head =
      head_of("GET / HTTP/1.1\r\nHost: a\r\nX-Empty:\r\nPrefer:\t wait=1 \r\nprefer: a%20b\r\n");
  EXPECT_EQ(head.headers,
            (Fields{{"Host", "a"}, {"X-Empty", ""}, {"Prefer", "wait=1"}, {"prefer", "a%20b"}}));
}

TEST(RequestHead, AHeaderMayBeAsLongAsTheHead) {
  EXPECT_EQ(refusal("GET / HTTP/1.1\r\nX-Long: " + std::string(16'000, 'x') + "\r\n"), 0);
}

TEST(RequestHead, TargetsAreDecodedOnce) {
  const Request request = request_of(head_of("GET /a%2Fb%2520?x=1+2&y=%26%3D&x=%C3%A9&z&q=a?b HTTP/1.1\r\n"));
  EXPECT_EQ(request.path, "/a/b%20");
  EXPECT_EQ(request.query, (Fields{{"q", "a?b"}, {"x", "1 2"}, {"x", "\xC3\xA9"}, {"y", "&="}, {"z", ""}}));
}

TEST(RequestHead, ABodyNeedsALength) {
  EXPECT_EQ(refusal("POST / HTTP/1.1\r\n"), 411);
  EXPECT_EQ(refusal("POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n"), 0);
  EXPECT_EQ(refusal("POST / HTTP/1.1\r\nTransfer-Encoding: Chunked\r\n"), 0);
}

TEST(RequestHead, ALengthAndChunksAreNotMixed) {
  EXPECT_EQ(refusal("POST / HTTP/1.1\r\nContent-Length: 1\r\nTransfer-Encoding: chunked\r\n"), 400);
  EXPECT_EQ(refusal("POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n"), 400);
  EXPECT_EQ(refusal("POST / HTTP/1.0\r\nTransfer-Encoding: chunked\r\n"), 400);
  for (const char* other :
       {"gzip, chunked", "chunked, identity", "identity", "gzip", "xchunked", "chunked;a=b", ""})
    EXPECT_EQ(refusal(std::string("POST / HTTP/1.1\r\nTransfer-Encoding: ") + other + "\r\n"), 400) << other;
}

TEST(RequestHead, TheBodyLimitIsExact) {
  HeadLimits limits;
  limits.body_bytes = 10;
  EXPECT_EQ(refusal("POST / HTTP/1.1\r\nContent-Length: 10\r\n", limits), 0);
  EXPECT_EQ(refusal("POST / HTTP/1.1\r\nContent-Length: 11\r\n", limits), 413);
  EXPECT_EQ(refusal("GET / HTTP/1.1\r\nContent-Length: 11\r\n", limits), 413);
  EXPECT_EQ(refusal("POST / HTTP/1.1\r\nContent-Length: 99999999999999999999999\r\n", limits), 413);
}

TEST(RequestHead, LengthsThatTwoReadersCouldReadDifferentlyAreRefused) {
  for (const char* header :
       {"Content-Length: -1", "Content-Length: +1", "Content-Length: 1,1", "Content-Length: 0x1",
        "Content-Length: ", "Content-Length: 1\r\nContent-Length: 1", "Content-Length : 1",
        " Content-Length: 1", ": 1", "no colon"}) {
    EXPECT_EQ(refusal("POST / HTTP/1.1\r\nHost: a\r\n" + std::string(header) + "\r\n"), 400) << header;
  }
}

TEST(RequestHead, CompressedBodiesAreRefused) {
  EXPECT_EQ(refusal("POST / HTTP/1.1\r\nContent-Length: 1\r\nContent-Encoding: gzip\r\n"), 415);
  EXPECT_EQ(refusal("POST / HTTP/1.1\r\nContent-Length: 1\r\nContent-Encoding: identity\r\n"), 0);
}

TEST(RequestHead, RequestLinesOfAnotherFormAreRefused) {
  for (const char* line :
       {"", "GET", "GET /", "GET  HTTP/1.1", "GET / HTTP/2", "GET /a b HTTP/1.1", "GET /a#b HTTP/1.1",
        "GET / HTTP/1.2", "GET / HTTP/1.1x", "GET /\x01 HTTP/1.1", "\x16\x03\x01"}) {
    EXPECT_EQ(refusal(std::string(line) + "\r\n"), 400) << line;
  }
}

TEST(RequestHead, UnknownMethodsAreRefused) {
  for (const char* method : {"FOO", "get", "CONNECT", "TRACE", "PRI"}) {
    EXPECT_EQ(refusal(std::string(method) + " / HTTP/1.1\r\n"), 501) << method;
  }
}

TEST(RequestHead, LongTargetsAndManyHeadersAreRefused) {
  const HeadLimits limits;
  EXPECT_EQ(refusal("GET /" + std::string(limits.target_bytes - 1, 'a') + " HTTP/1.1\r\n"), 0);
  EXPECT_EQ(refusal("GET /" + std::string(limits.target_bytes, 'a') + " HTTP/1.1\r\n"), 414);
  std::string headers;
  for (std::size_t i = 1; i < limits.header_count; ++i) {  // Host is one, too
    headers += "A: b\r\n";
  }
  EXPECT_EQ(refusal("GET / HTTP/1.1\r\n" + headers), 0);
  EXPECT_EQ(refusal("GET / HTTP/1.1\r\n" + headers + "A: b\r\n"), 431);
}

}  // namespace
}  // namespace snapthrough::server::http
