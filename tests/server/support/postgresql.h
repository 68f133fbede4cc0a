#pragma once
/// @file
/// A server of PostgreSQL for tests.

#include <string>

namespace snapthrough::server::test {

/// @brief The location of a schema that is a test's own, by that name. The server is that of
/// TEST_POSTGRESQL if it is set (ctest sets it), else one that begins now and ends with this process.
[[nodiscard]] std::string postgresql_location(const std::string& name);
/// The location of a database that is a test's own, by that name: other tests' notifications do not reach it.
[[nodiscard]] std::string postgresql_database(const std::string& name);

}  // namespace snapthrough::server::test
