#include "server/resources/job_key.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace snapthrough::server::http {
namespace {

constexpr std::string_view kPrefix = "job_";
constexpr std::string_view kDigits = "0123456789abcdef";
constexpr std::size_t kWords = 4;  // words of 64 random bits
constexpr std::size_t kDigitsOfAWord = 16;

/// What the key of a job reads, behind the path of the job.
constexpr std::array<std::string_view, 5> kReadable{"", "/result", "/table.csv", "/request", "/events"};

}  // namespace

std::string new_job_key(const Environment& environment) {
  std::string key(kPrefix);
  for (std::size_t word = 0; word < kWords; ++word) {
    std::uint64_t bits = environment.random_bits();
    for (std::size_t digit = 0; digit < kDigitsOfAWord; ++digit, bits >>= 4U) {
      key += kDigits[bits & 15U];
    }
  }
  return key;
}

bool is_job_key(std::string_view text) {
  return text.starts_with(kPrefix) && text.size() == kPrefix.size() + kWords * kDigitsOfAWord &&
         text.find_first_not_of(kDigits, kPrefix.size()) == std::string_view::npos;
}

bool job_key_permits(std::string_view method, std::string_view path) {
  static constexpr std::string_view kJobs = "/v1/jobs/";
  if ((method != "GET" && method != "HEAD") || !path.starts_with(kJobs)) {
    return false;
  }
  path.remove_prefix(kJobs.size());
  const std::size_t end = std::min(path.find('/'), path.size());
  return is_id(path.substr(0, end)) &&
         std::find(kReadable.begin(), kReadable.end(), path.substr(end)) != kReadable.end();
}

}  // namespace snapthrough::server::http
