#pragma once
/// @file
/// A plain HTTP client on sockets: it sends the bytes it is told to, right or wrong.

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace snapthrough::server::test {

struct Reply {
  int status = 0;
  std::vector<std::pair<std::string, std::string>> headers;
  std::string body;
  bool whole = true;  ///< a chunked body had its end

  /// The header's value, empty when it is missing.
  [[nodiscard]] std::string header(const std::string& name) const;
};

/// A connection to 127.0.0.1.
class Socket {
 public:
  explicit Socket(int port);
  ~Socket();
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  Socket(Socket&&) = delete;
  Socket& operator=(Socket&&) = delete;

  void send(const std::string& bytes) const;
  /// Ends the sending side; responses can still be received.
  void end_sending() const;
  /// The next response; status 0 when the connection ends first. Interim responses (1xx) are returned too.
  Reply receive(bool without_body = false);
  /// Everything up to and with the mark; less when the other side closes first.
  std::string read_until(const std::string& mark);
  /// Everything until the other side closes.
  std::string rest();
  /// The same, in pieces with a pause after each; the kernel keeps little meanwhile. Sets `longest` to the
  /// longest of these pauses, which a busy machine may extend.
  std::string read_slowly(std::size_t piece, std::chrono::milliseconds pause,
                          std::chrono::milliseconds& longest);
  /// Whether something has arrived, or the other side has closed.
  [[nodiscard]] bool readable() const;
  /// Whether the other side has closed and nothing is left to read.
  [[nodiscard]] bool at_end();
  /// Reads until the other side ends the connection. Returns whether it did so by a reset, which may destroy
  /// what it had sent before.
  [[nodiscard]] bool was_reset();

 private:
  bool fill();
  void receive_chunks(Reply& reply);
  int descriptor_;
  int error_ = 0;  ///< errno of the latest read; 0: it did not fail
  std::string buffer_;
};

using Headers = std::vector<std::string>;  ///< "Name: value"

/// One request on a connection of its own.
Reply get(int port, const std::string& target, const Headers& headers = {});
Reply post(int port, const std::string& target, const std::string& body,
           const Headers& headers = {"Content-Type: application/json"});
Reply call(int port, const std::string& method, const std::string& target, const std::string& body,
           const Headers& headers);

}  // namespace snapthrough::server::test
