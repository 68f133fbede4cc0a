/// Request bodies in chunks: what RFC 9112, 7.1, allows without extensions and trailers, and nothing else.
#include "server/front/chunked_body.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "server/front/request_reader.h"

namespace snapthrough::server::http {
namespace {

using Kind = Received::Kind;

constexpr std::string_view kHead =
    "POST /v1/check HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n";
constexpr std::string_view kNext = "GET /livez HTTP/1.1\r\nHost: localhost\r\n\r\n";

std::string hex(std::size_t value) {
  char text[20];
  return {text, static_cast<std::size_t>(snprintf(text, sizeof text, "%zX", value))};
}

std::string in_chunks(const std::vector<std::string>& pieces) {
  std::string out;
  for (const std::string& piece : pieces) out += hex(piece.size()) + "\r\n" + piece + "\r\n";
  return out + "0\r\n\r\n";
}

/// The refusal of a request with these bytes for a body; 0: none so far.
int refusal(const std::string& body, std::size_t limit = 1000) {
  HeadLimits limits;
  limits.body_bytes = limit;
  RequestReader reader(limits);
  reader.append(std::string(kHead) + body);
  const Received received = reader.next();
  return received.head.refusal ? received.head.refusal->status : 0;
}

TEST(ChunkedBody, IsDecodedHoweverItsBytesArrive) {
  const std::string all = std::string(kHead) + in_chunks({"{\"a\":", " 1", "}"}) + std::string(kNext);
  const HeadLimits limits;
  for (std::size_t cut = 1; cut < all.size(); ++cut) {
    RequestReader reader(limits);
    reader.append(std::string_view(all).substr(0, cut));
    Received received = reader.next();
    if (received.kind != Kind::request) {
      reader.append(std::string_view(all).substr(cut));
      received = reader.next();
    } else {
      reader.append(std::string_view(all).substr(cut));
    }
    ASSERT_EQ(received.kind, Kind::request) << cut;
    EXPECT_EQ(received.body, "{\"a\": 1}") << cut;
    const Received next = reader.next();
    EXPECT_EQ(next.kind, Kind::request) << cut;
    EXPECT_EQ(next.head.target, "/livez") << cut;
  }
}

TEST(ChunkedBody, ByteByByteHoldsNoMoreThanTheBody) {
  const std::string chunks = in_chunks(std::vector<std::string>(1000, "x"));
  HeadLimits limits;
  limits.body_bytes = 1000;
  RequestReader reader(limits);
  reader.append(kHead);
  Received received = reader.next();
  for (const char byte : chunks) {
    ASSERT_EQ(received.kind, Kind::body_incomplete);
    reader.append(std::string_view(&byte, 1));
    received = reader.next();
    ASSERT_LE(reader.held(), 1000U + 20U);
  }
  EXPECT_EQ(received.body, std::string(1000, 'x'));
}

TEST(ChunkedBody, TheLimitIsThatOfTheDecodedBody) {
  EXPECT_EQ(refusal(in_chunks({std::string(600, 'x'), std::string(400, 'x')})), 0);
  EXPECT_EQ(refusal(in_chunks({std::string(600, 'x'), std::string(401, 'x')})), 413);
  EXPECT_EQ(refusal("3E9\r\n"), 413);  // before a byte of the chunk
  EXPECT_EQ(refusal("FFFFFFFFFFFFFFFF\r\n"), 413);
}

TEST(ChunkedBody, WhatIsNoChunkIsRefused) {
  for (const char* body : {"\r\n", "x\r\n", "-1\r\n", "+1\r\na\r\n", " 1\r\na\r\n", "1 \r\na\r\n",
                           "0x1\r\na\r\n", "1;name=value\r\na\r\n0\r\n\r\n", "1\na\n0\n\n",
                           "1\r\nab\r\n0\r\n\r\n", "2\r\na\r\n0\r\n\r\n", "0\r\nTrailer: x\r\n\r\n",
                           "00000000000000001\r\na\r\n", "1\r\na0\r\n\r\n", "0;x\r\n\r\n", "1\r\ra\r\n"})
    EXPECT_EQ(refusal(body), 400) << body;
}

/// A wrong chunking made from a right one.
std::string spoilt(std::mt19937& random) {
  const auto draw = [&](std::size_t most) { return random() % most; };
  std::vector<std::string> pieces(1 + draw(4));
  for (std::string& piece : pieces) piece.assign(1 + draw(40), static_cast<char>('a' + draw(26)));
  const std::size_t at = draw(pieces.size());
  std::string out;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::string size = hex(pieces[i].size());
    if (i != at) {
      out += size + "\r\n" + pieces[i] + "\r\n";
      continue;
    }
    const std::vector<std::string> wrong{
        size + ";a=b\r\n" + pieces[i] + "\r\n",
        size + "\n" + pieces[i] + "\r\n",
        size + "\r\n" + pieces[i] + "\n",
        size + "\r\n" + pieces[i] + "x\r\n",
        size + "\r\n" + pieces[i].substr(1) + "\r\n",
        " " + size + "\r\n" + pieces[i] + "\r\n",
        size + " \r\n" + pieces[i] + "\r\n",
        "0x" + size + "\r\n" + pieces[i] + "\r\n",
        std::string(17 - size.size(), '0') + size + "\r\n" + pieces[i] + "\r\n",
        "\r\n" + pieces[i] + "\r\n",
        "-" + size + "\r\n" + pieces[i] + "\r\n",
        "g\r\n" + pieces[i] + "\r\n",
        "0\r\nTrailer: x\r\n\r\n"};
    out += wrong[draw(wrong.size())];
  }
  return out + "0\r\n\r\n";
}

TEST(ChunkedBody, FiveHundredWrongChunkingsAreRefused) {
  std::mt19937 random(20261125);
  for (int i = 0; i < 500; ++i) {
    const std::string body = spoilt(random);
    EXPECT_EQ(refusal(body), 400) << body;
  }
}

}  // namespace
}  // namespace snapthrough::server::http
