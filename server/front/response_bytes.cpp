#include "server/front/response_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <new>
#include <utility>
#include <vector>

#include "server/resources/negotiation.h"

namespace snapthrough::server::http {
namespace {

constexpr std::size_t kWorthCompressing = 1400;  // bytes; a body of one packet gains nothing

bool begin_gzip(z_stream& stream) {
  constexpr int kGzip = 15 + 16;
  return ::deflateInit2(&stream, 1, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY) == Z_OK;
}

/// Returns the body in gzip format; "" when zlib fails.
std::string gzip(const std::string& body) {
  z_stream stream{};
  if (!begin_gzip(stream)) {
    return {};
  }
  std::string packed(::deflateBound(&stream, body.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(body.data()));  // zlib does not write to it
  stream.avail_in = static_cast<uInt>(body.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const bool whole = ::deflate(&stream, Z_FINISH) == Z_STREAM_END;
  packed.resize(whole ? stream.total_out : 0);
  ::deflateEnd(&stream);
  return packed;
}

/// Compresses a body that is sent in pieces to gzip format.
class GzipSource final : public BodySource {
 public:
  explicit GzipSource(std::shared_ptr<BodySource> plain) : plain_(std::move(plain)) {
    if (!begin_gzip(stream_)) {
      throw std::bad_alloc();
    }
  }
  ~GzipSource() override { ::deflateEnd(&stream_); }
  GzipSource(const GzipSource&) = delete;
  GzipSource& operator=(const GzipSource&) = delete;
  GzipSource(GzipSource&&) = delete;
  GzipSource& operator=(GzipSource&&) = delete;

  StatusOr<bool> append_next(std::string& piece) override {
    std::string text;
    StatusOr<bool> more = plain_->append_next(text);
    if (more.ok()) {
      append_packed(text, !*more, piece);
    }
    return more;
  }
  [[nodiscard]] std::size_t held_bytes() const override {
    constexpr std::size_t kWindowAndTables = 270'000;
    return kWindowAndTables + plain_->held_bytes();
  }
  void append_packed(std::string_view text, bool last, std::string& packed) {
    std::array<char, 16 * 1024> chunk;
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));  // zlib does not write to it
    stream_.avail_in = static_cast<uInt>(text.size());
    do {
      stream_.next_out = reinterpret_cast<Bytef*>(chunk.data());
      stream_.avail_out = chunk.size();
      ::deflate(&stream_, last ? Z_FINISH : Z_NO_FLUSH);
      packed.append(chunk.data(), chunk.size() - stream_.avail_out);
    } while (stream_.avail_out == 0);
  }

 private:
  z_stream stream_{};
  std::shared_ptr<BodySource> plain_;
};

/// Compresses the body. Returns false when that does not make it smaller.
bool pack(Response& response) {
  if (response.rest) {
    const auto source = std::make_shared<GzipSource>(std::move(response.rest));
    std::string packed;
    source->append_packed(response.body, false, packed);
    response.body = std::move(packed);
    response.rest = source;
    return true;
  }
  std::string packed = gzip(response.body);
  if (packed.empty() || packed.size() >= response.body.size()) {
    return false;
  }
  response.body = std::move(packed);
  return true;
}

}  // namespace

std::string_view reason_phrase(int status) {
  static constexpr std::pair<int, std::string_view> kPhrases[] = {
      {200, "OK"},
      {201, "Created"},
      {202, "Accepted"},
      {204, "No Content"},
      {302, "Found"},
      {304, "Not Modified"},
      {308, "Permanent Redirect"},
      {400, "Bad Request"},
      {401, "Unauthorized"},
      {403, "Forbidden"},
      {404, "Not Found"},
      {405, "Method Not Allowed"},
      {406, "Not Acceptable"},
      {409, "Conflict"},
      {411, "Length Required"},
      {413, "Content Too Large"},
      {414, "URI Too Long"},
      {415, "Unsupported Media Type"},
      {422, "Unprocessable Content"},
      {429, "Too Many Requests"},
      {431, "Request Header Fields Too Large"},
      {500, "Internal Server Error"},
      {501, "Not Implemented"},
      {503, "Service Unavailable"},
  };
  const auto* found = std::find_if(std::begin(kPhrases), std::end(kPhrases),
                                   [&](const auto& row) { return row.first == status; });
  return found == std::end(kPhrases) ? "Unknown" : found->second;
}

std::string to_bytes(const Response& response, bool head_only, bool keep_alive, bool chunked) {
  std::string bytes;
  bytes.reserve(512 + (head_only ? 0 : response.body.size()));
  bytes.append("HTTP/1.1 ").append(std::to_string(response.status)).append(" ");
  bytes.append(reason_phrase(response.status)).append("\r\n");
  for (const auto& [name, value] : response.headers) {
    bytes.append(name).append(": ").append(value).append("\r\n");
  }
  if (!response.content_type.empty()) {
    bytes.append("Content-Type: ").append(response.content_type).append("\r\n");
  }
  const bool bodiless = response.status == 204 || response.status == 304;
  if (response.rest && chunked) {
    bytes.append("Transfer-Encoding: chunked\r\n");
  } else if (!response.stream && !response.rest && !bodiless) {
    bytes.append("Content-Length: ").append(std::to_string(response.body.size())).append("\r\n");
  }
  bytes.append(keep_alive ? "Connection: keep-alive\r\n\r\n" : "Connection: close\r\n\r\n");
  if (head_only || bodiless || response.stream) {
    return bytes;
  }
  if (response.rest && chunked) {
    append_chunk(bytes, response.body, false);
  } else {
    bytes.append(response.body);
  }
  return bytes;
}

void append_chunk(std::string& bytes, std::string_view piece, bool last) {
  if (!piece.empty()) {  // an empty chunk would end the body
    std::array<char, 20> size{};
    const char* end = std::to_chars(size.data(), size.data() + size.size(), piece.size(), 16).ptr;
    bytes.append(std::string_view(size.data(), end)).append("\r\n").append(piece).append("\r\n");
  }
  bytes.append(last ? "0\r\n\r\n" : "");
}

void compress(Response& response, std::string_view accept_encoding) {
  const bool small = response.body.size() < kWorthCompressing && !response.rest;
  if (response.status != 200 || small || response.header("Content-Encoding")) {
    return;
  }
  response.headers.emplace_back("Vary", "Accept, Accept-Encoding");
  if (!takes_gzip(accept_encoding) || !pack(response)) {
    return;
  }
  response.headers.emplace_back("Content-Encoding", "gzip");
  for (auto& [name, value] : response.headers) {
    if (name == "ETag" && value.size() > 2) {
      value.insert(value.size() - 1, "-gzip");
    }
  }
}

}  // namespace snapthrough::server::http
