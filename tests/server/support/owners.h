#pragma once
/// @file
/// Two owners with keys, for services that ask for one.

#include <vector>

#include "server/front/keys.h"

namespace snapthrough::server::test {

/// The owners ann, whose key is "alice", and bob, whose key is "bob"; digests from sha256sum.
inline std::vector<http::ApiKey> ann_and_bob() {
  return {{"ann", "2bd806c97f0e00af1a1fc3328fa763a9269723c8db8fac4f93af71db186d6e90"},
          {"bob", "81b637d8fcd2c6da6359e6963113a1170de795e4b725b84d1e0b4cfd9ec58ce9"}};
}

}  // namespace snapthrough::server::test
