#include "api/sha256.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace snapthrough::api {
namespace {

constexpr std::size_t kBlock = 64;
constexpr std::size_t kRounds = 64;
using State = std::array<std::uint32_t, 8>;

/// First 32 bits of the fractional part of a root of a prime.
std::uint32_t fraction_bits(long double root) {
  return static_cast<std::uint32_t>(std::floor((root - std::floor(root)) * 4294967296.0L));
}

bool is_prime(int number) {
  for (int divisor = 2; divisor * divisor <= number; ++divisor) {
    if (number % divisor == 0) {
      return false;
    }
  }
  return true;
}

struct Constants {
  State start{};                                ///< from the square roots of the first 8 primes
  std::array<std::uint32_t, kRounds> rounds{};  ///< from the cube roots of the first 64 primes
};

Constants make_constants() {
  Constants constants;
  std::size_t count = 0;
  for (int number = 2; count < kRounds; ++number) {
    if (!is_prime(number)) {
      continue;
    }
    if (count < constants.start.size()) {
      constants.start[count] = fraction_bits(std::sqrt(static_cast<long double>(number)));
    }
    constants.rounds[count++] = fraction_bits(std::cbrt(static_cast<long double>(number)));
  }
  return constants;
}

const Constants& constants() {
  static const Constants kConstants = make_constants();
  return kConstants;
}

std::uint32_t big_endian(const char* bytes) {
  std::uint32_t word = 0;
  for (int i = 0; i < 4; ++i) {
    word = word << 8U | static_cast<unsigned char>(bytes[i]);
  }
  return word;
}

/// Section 6.2.2 of the standard.
void add_block(State& state, const char* block) {
  std::array<std::uint32_t, kRounds> words{};
  for (std::size_t t = 0; t < 16; ++t) {
    words[t] = big_endian(block + 4 * t);
  }
  for (std::size_t t = 16; t < kRounds; ++t) {
    const std::uint32_t late = words[t - 2];
    const std::uint32_t early = words[t - 15];
    words[t] = (std::rotr(late, 17) ^ std::rotr(late, 19) ^ late >> 10U) + words[t - 7] +
               (std::rotr(early, 7) ^ std::rotr(early, 18) ^ early >> 3U) + words[t - 16];
  }
  auto [a, b, c, d, e, f, g, h] = state;
  for (std::size_t t = 0; t < kRounds; ++t) {
    const std::uint32_t first = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                                ((e & f) ^ (~e & g)) + constants().rounds[t] + words[t];
    const std::uint32_t second =
        (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
    h = g;
    g = f;
    f = e;
    e = d + first;
    d = c;
    c = b;
    b = a;
    a = first + second;
  }
  const State sums{a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < state.size(); ++i) {
    state[i] += sums[i];
  }
}

/// The bytes after the last whole block, padded to one or two blocks with a bit and the length.
std::string padded_rest(std::string_view bytes) {
  std::string rest(bytes.substr(bytes.size() - bytes.size() % kBlock));
  rest += '\x80';
  rest.append((2 * kBlock - 8 - rest.size() % kBlock) % kBlock, '\0');
  const std::uint64_t bits = 8 * static_cast<std::uint64_t>(bytes.size());
  for (int shift = 56; shift >= 0; shift -= 8) {
    rest += static_cast<char>(bits >> static_cast<unsigned>(shift) & 255U);
  }
  return rest;
}

}  // namespace

std::string sha256_digest(std::string_view bytes) {
  static constexpr std::string_view kDigits = "0123456789abcdef";
  State state = constants().start;
  const std::string rest = padded_rest(bytes);
  for (std::size_t at = 0; at + kBlock <= bytes.size(); at += kBlock) {
    add_block(state, bytes.data() + at);
  }
  for (std::size_t at = 0; at < rest.size(); at += kBlock) {
    add_block(state, rest.data() + at);
  }
  std::string text;
  for (const std::uint32_t word : state) {
    for (int shift = 28; shift >= 0; shift -= 4) {
      text += kDigits[word >> static_cast<unsigned>(shift) & 15U];
    }
  }
  return text;
}

}  // namespace snapthrough::api
