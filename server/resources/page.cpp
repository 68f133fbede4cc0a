#include "server/resources/page.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "api/openapi/field_table.h"
#include "server/digest.h"
#include "server/resources/negotiation.h"

namespace snapthrough::server::http {
namespace {

constexpr std::string_view kAssets = "/assets/";
constexpr std::string_view kDocuments = "/docs/";
/// The interface as the page shows it has an address that can be read out.
constexpr std::string_view kInterface = "/docs";
// Allows scripts, styles and requests of the service only. Exported pictures are drawn from a blob.
constexpr const char* kContentSecurityPolicy =
    "default-src 'self'; img-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; "
    "object-src 'none'";

const char* content_type(std::string_view path) {
  static constexpr std::array<std::pair<std::string_view, const char*>, 5> kTypes{
      {{".js", "text/javascript; charset=utf-8"},
       {".md", "text/markdown; charset=utf-8"},
       {".css", "text/css; charset=utf-8"},
       {".svg", "image/svg+xml"},
       {".json", "application/json"}}};
  const auto* found = std::find_if(kTypes.begin(), kTypes.end(),
                                   [&](const auto& type) { return path.ends_with(type.first); });
  return found == kTypes.end() ? "text/html; charset=utf-8" : found->second;
}

/// Adds headers; assets are cached for a year, because their names change with their content.
void add_headers(Response& response, std::string_view path, const std::string& etag, bool changes) {
  response.content_type = content_type(path);
  response.headers.emplace_back("ETag", etag);
  response.headers.emplace_back("Cache-Control", path.starts_with(kAssets) && !changes
                                                     ? "public, max-age=31536000, immutable"
                                                     : "no-cache");
  response.headers.emplace_back("Content-Security-Policy", kContentSecurityPolicy);
  response.headers.emplace_back("Referrer-Policy", "no-referrer");
}

std::string unpacked(std::span<const unsigned char> packed) {
  constexpr int kGzip = 15 + 16;
  z_stream stream{};
  if (::inflateInit2(&stream, kGzip) != Z_OK) {
    throw std::bad_alloc();
  }
  stream.next_in = const_cast<Bytef*>(packed.data());  // zlib does not write to it
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string text;
  std::array<char, 16 * 1024> chunk;
  int code = Z_OK;
  while (code == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_out = chunk.size();
    code = ::inflate(&stream, Z_NO_FLUSH);
    text.append(chunk.data(), chunk.size() - stream.avail_out);
  }
  ::inflateEnd(&stream);
  if (code != Z_STREAM_END) {
    throw std::runtime_error("a file of the page is damaged");
  }
  return text;
}

Response not_modified(std::string_view path, const std::string& etag, bool changes) {
  Response response;
  add_headers(response, path, etag, changes);
  response.status = 304;
  response.content_type.clear();
  return response;
}

std::optional<Response> fields_document(const Request& request) {
  const std::vector<FieldsDocument>& all = fields_documents();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const FieldsDocument& one) { return one.path == request.path; });
  if (found == all.end()) {
    return std::nullopt;
  }
  if (matches_etag(request, found->etag)) {
    return not_modified(found->path, found->etag, false);
  }
  Response response;
  add_headers(response, found->path, found->etag, false);
  response.body = found->text;
  return response;
}

std::optional<Response> built_in(const Request& request) {
  if (std::optional<Response> document = fields_document(request)) {
    return document;
  }
  const std::vector<PageFile>& files = embedded_page();
  const auto file =
      std::find_if(files.begin(), files.end(), [&](const PageFile& one) { return one.path == request.path; });
  if (file == files.end()) {
    return std::nullopt;
  }
  const std::string etag = "\"" + std::string(file->digest) + "\"";
  if (matches_etag(request, etag)) {
    return not_modified(file->path, etag, false);
  }
  Response response;
  if (takes_gzip(request.header("Accept-Encoding").value_or(""))) {
    add_headers(response, file->path, etag.substr(0, etag.size() - 1) + "-gzip\"", false);
    response.headers.emplace_back("Vary", "Accept-Encoding");
    response.headers.emplace_back("Content-Encoding", "gzip");
    response.body.assign(file->packed.begin(), file->packed.end());
  } else {
    add_headers(response, file->path, etag, false);
    response.body = unpacked(file->packed);
  }
  return response;
}

/// Returns whether a name has only letters, digits, "-", "_" and ".", so that no path leaves the folder.
bool is_file_name(std::string_view name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '.';
  };
  return !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), allowed);
}

std::optional<Response> of_folder(const std::filesystem::path& folder, const Request& request) {
  std::filesystem::path path = folder / "index.html";
  if (request.path != "/") {
    const std::string_view name = std::string_view(request.path).substr(kAssets.size());
    if (!is_file_name(name)) {
      return std::nullopt;
    }
    path = folder / "assets" / name;
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return std::nullopt;
  }
  Response response;
  response.body.assign(std::istreambuf_iterator<char>(file), {});
  const std::string etag = "\"" + sha256_hex(response.body) + "\"";
  if (matches_etag(request, etag)) {
    return not_modified(request.path, etag, true);
  }
  add_headers(response, request.path, etag, true);
  return response;
}

}  // namespace

const std::vector<FieldsDocument>& fields_documents() {
  static const std::vector<FieldsDocument> all = [] {
    std::vector<FieldsDocument> found;
    for (const PageFile& file : embedded_page()) {
      if (!file.path.ends_with(".md")) {
        continue;
      }
      const std::string text = unpacked(file.packed);
      if (std::string made = api::with_field_tables(text); made != text) {
        const std::string etag = "\"" + sha256_hex(made) + "\"";
        found.push_back({file.path, std::move(made), etag});
      }
    }
    return found;
  }();
  return all;
}

bool is_page_path(std::string_view path) {
  return path == "/" || path == kInterface || path.starts_with(kAssets) || path.starts_with(kDocuments);
}

std::optional<Response> Page::respond(const Request& request) const {
  if (source_ == kNoPage || !is_page_path(request.path)) {
    return std::nullopt;
  }
  if (request.path == kInterface) {
    Response response;
    response.status = 302;
    response.headers.emplace_back("Location", "/#/docs/interface");
    response.route = kInterface;
    return response;
  }
  const bool document = request.path.starts_with(kDocuments);
  std::optional<Response> response =
      document || source_ == kEmbeddedPage ? built_in(request) : of_folder(source_, request);
  if (response) {
    response->route = request.path == "/" ? "/" : document ? "/docs/{name}" : "/assets/{name}";
  }
  return response;
}

}  // namespace snapthrough::server::http
