#include "server/environment.h"

#include <array>
#include <cstdio>
#include <random>
#include <string_view>

namespace snapthrough::server {
namespace {

struct CivilTime {
  std::chrono::year_month_day date;
  std::chrono::weekday weekday;
  std::chrono::hh_mm_ss<std::chrono::microseconds> clock;
};

CivilTime civil(Time time) {
  const auto day = std::chrono::floor<std::chrono::days>(time);
  return {std::chrono::year_month_day{day}, std::chrono::weekday{day},
          std::chrono::hh_mm_ss<std::chrono::microseconds>{time - day}};
}

std::uint64_t system_random_bits() {
  thread_local std::random_device device;
  return (static_cast<std::uint64_t>(device()) << 32) | device();
}

}  // namespace

Environment Environment::system() {
  return {[] { return std::chrono::floor<std::chrono::microseconds>(std::chrono::system_clock::now()); },
          [] {
            return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
          },
          system_random_bits};
}

std::string rfc3339(Time time) {
  const CivilTime t = civil(time);
  std::array<char, 64> text{};
  const int size = std::snprintf(
      text.data(), text.size(), "%04d-%02u-%02uT%02d:%02d:%02d.%06dZ", static_cast<int>(t.date.year()),
      static_cast<unsigned>(t.date.month()), static_cast<unsigned>(t.date.day()),
      static_cast<int>(t.clock.hours().count()), static_cast<int>(t.clock.minutes().count()),
      static_cast<int>(t.clock.seconds().count()), static_cast<int>(t.clock.subseconds().count()));
  return {text.data(), static_cast<std::size_t>(size)};
}

std::string http_date(Time time) {
  static constexpr std::array<const char*, 7> kDays{"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
  static constexpr std::array<const char*, 12> kMonths{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                       "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  const CivilTime t = civil(time);
  std::array<char, 64> text{};
  const int size = std::snprintf(
      text.data(), text.size(), "%s, %02u %s %04d %02d:%02d:%02d GMT", kDays[t.weekday.c_encoding()],
      static_cast<unsigned>(t.date.day()), kMonths[static_cast<unsigned>(t.date.month()) - 1],
      static_cast<int>(t.date.year()), static_cast<int>(t.clock.hours().count()),
      static_cast<int>(t.clock.minutes().count()), static_cast<int>(t.clock.seconds().count()));
  return {text.data(), static_cast<std::size_t>(size)};
}

std::string new_id(const Environment& environment) {
  const auto milliseconds = static_cast<std::uint64_t>(
      std::chrono::floor<std::chrono::milliseconds>(environment.now()).time_since_epoch().count());
  const std::uint64_t high = (milliseconds << 16) | 0x7000U | (environment.random_bits() & 0x0FFFU);
  const std::uint64_t low = (environment.random_bits() & 0x3FFFFFFFFFFFFFFFU) | 0x8000000000000000U;
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%08x-%04x-%04x-%04x-%012llx", static_cast<unsigned>(high >> 32),
                static_cast<unsigned>((high >> 16) & 0xFFFFU), static_cast<unsigned>(high & 0xFFFFU),
                static_cast<unsigned>(low >> 48), static_cast<unsigned long long>(low & 0xFFFFFFFFFFFFU));
  return {text.data(), 36};
}

bool is_id(std::string_view text) {
  if (text.size() != 36) {
    return false;
  }
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool dash = i == 8 || i == 13 || i == 18 || i == 23;
    const bool hex = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
    if (dash ? c != '-' : !hex) {
      return false;
    }
  }
  return true;
}

}  // namespace snapthrough::server
