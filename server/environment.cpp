#include "server/environment.h"

#include <algorithm>
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

/// Returns the number that `count` digits from index `at` form; nullopt when they are not all digits.
std::optional<int> digits(std::string_view text, std::size_t at, std::size_t count) {
  int value = 0;
  for (const char c : text.substr(at, count)) {
    if (c < '0' || c > '9') {
      return std::nullopt;
    }
    value = 10 * value + (c - '0');
  }
  return text.size() >= at + count ? std::optional(value) : std::nullopt;
}

/// Returns fraction minus offset of what follows the seconds of a time ("", ".25" before "Z", "+01:00").
std::optional<std::chrono::microseconds> fraction_and_offset(std::string_view text) {
  std::chrono::microseconds sum{0};
  if (text.starts_with('.')) {
    const std::size_t end = std::min(text.find_first_not_of("0123456789", 1), text.size());
    std::string fraction(text.substr(1, end - 1));
    if (fraction.empty() || fraction.size() > 6) {
      return std::nullopt;
    }
    fraction.resize(6, '0');
    sum = std::chrono::microseconds(digits(fraction, 0, 6).value());
    text.remove_prefix(end);
  }
  if (text == "Z") {
    return sum;
  }
  if (text.size() != 6 || (text[0] != '+' && text[0] != '-') || text[3] != ':') {
    return std::nullopt;
  }
  const auto hours = digits(text, 1, 2);
  const auto minutes = digits(text, 4, 2);
  if (!hours || !minutes || *hours > 23 || *minutes > 59) {
    return std::nullopt;
  }
  const auto offset = std::chrono::hours(*hours) + std::chrono::minutes(*minutes);
  return text[0] == '+' ? sum - offset : sum + offset;
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

std::optional<Time> time_from(std::string_view text) {
  const bool valid_separators = text.size() >= 20 && text[4] == '-' && text[7] == '-' && text[10] == 'T' &&
                                text[13] == ':' && text[16] == ':';
  if (!valid_separators) {
    return std::nullopt;
  }
  const auto year = digits(text, 0, 4);
  const auto month = digits(text, 5, 2);
  const auto day = digits(text, 8, 2);
  const auto hour = digits(text, 11, 2);
  const auto minute = digits(text, 14, 2);
  const auto second = digits(text, 17, 2);
  const auto rest = fraction_and_offset(text.substr(19));
  if (!year || !month || !day || !hour || !minute || !second || !rest) {
    return std::nullopt;
  }
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok() || *year < 1970 || *hour > 23 || *minute > 59 || *second > 59) {
    return std::nullopt;
  }
  return std::chrono::sys_days(date) + std::chrono::hours(*hour) + std::chrono::minutes(*minute) +
         std::chrono::seconds(*second) + *rest;
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
