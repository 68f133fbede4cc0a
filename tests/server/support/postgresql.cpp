#include "tests/server/support/postgresql.h"

#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

#include "server/store/postgresql/connection.h"

namespace snapthrough::server::test {
namespace {

const std::string kScript = "bash " SNAPTHROUGH_SOURCE_DIR "/scripts/lib/postgresql.sh ";

/// Ends with this process: the script watches the shell that runs it, which waits for this process.
std::string start_server() {
  const std::string folder = "/tmp/snapthrough_postgresql_" + std::to_string(::getpid());
  const std::string life = std::to_string(::getpid());
  if (std::system(("LIFE=" + life + " " + kScript + "start " + folder).c_str()) != 0) {
    throw std::runtime_error("PostgreSQL did not start");
  }
  return "postgresql://snapthrough@/snapthrough?host=" + folder;
}

const std::string& server_location() {
  static const std::string server = [] {
    const char* given = std::getenv("TEST_POSTGRESQL");
    return given != nullptr ? std::string(given) : start_server();
  }();
  return server;
}

}  // namespace

std::string postgresql_location(const std::string& name) {
  const std::string& server = server_location();
  postgresql::Connection(server).execute("SET client_min_messages = warning; CREATE SCHEMA IF NOT EXISTS \"" +
                                         name + "\"");
  return server + "&options=-csearch_path%3D%22" + name + "%22";
}

std::string postgresql_database(const std::string& name) {
  postgresql::Connection(server_location()).execute("CREATE DATABASE \"" + name + "\"");
  return server_location() + "&dbname=" + name;  // the last of two names counts
}

}  // namespace snapthrough::server::test
