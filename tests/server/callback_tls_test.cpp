/// @file
/// Callbacks over TLS: whom the service takes for the host that is allowed.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>
#include <poll.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <thread>

#include "server/front/sockets.h"
#include "server/webhooks/post.h"
#include "tests/server/support/eventually.h"
#include "tests/server/support/temp_dir.h"

namespace snapthrough::server::test {
namespace {

template <class T, void (*free_it)(T*)>
struct Free {
  void operator()(T* pointer) const { free_it(pointer); }
};
using Key = std::unique_ptr<EVP_PKEY, Free<EVP_PKEY, ::EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Free<X509, ::X509_free>>;
using Context = std::unique_ptr<SSL_CTX, Free<SSL_CTX, ::SSL_CTX_free>>;
using Session = std::unique_ptr<SSL, Free<SSL, ::SSL_free>>;

/// A certificate for a host that nobody but itself has signed.
Certificate self_signed(EVP_PKEY* key, const std::string& host) {
  Certificate certificate(::X509_new());
  ::X509_set_version(certificate.get(), 2);
  ::ASN1_INTEGER_set(::X509_get_serialNumber(certificate.get()), 1);
  ::X509_gmtime_adj(::X509_getm_notBefore(certificate.get()), -3600);
  ::X509_gmtime_adj(::X509_getm_notAfter(certificate.get()), 3600);
  ::X509_set_pubkey(certificate.get(), key);
  X509_NAME* name = ::X509_get_subject_name(certificate.get());
  ::X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, reinterpret_cast<const unsigned char*>("test"), -1,
                               -1, 0);
  ::X509_set_issuer_name(certificate.get(), name);
  X509_EXTENSION* names =
      ::X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, ("DNS:" + host).c_str());
  ::X509_add_ext(certificate.get(), names, -1);
  ::X509_EXTENSION_free(names);
  ::X509_sign(certificate.get(), key, ::EVP_sha256());
  return certificate;
}

/// Takes every request on 127.0.0.1, with a certificate for that host, and counts them.
class TlsReceiver {
 public:
  TlsReceiver(const std::string& host, const std::string& file)
      : key_(::EVP_EC_gen("P-256")), certificate_(self_signed(key_.get(), host)) {
    ::SSL_CTX_use_certificate(context_.get(), certificate_.get());
    ::SSL_CTX_use_PrivateKey(context_.get(), key_.get());
    std::FILE* out = std::fopen(file.c_str(), "w");
    ::PEM_write_X509(out, certificate_.get());
    std::fclose(out);
    thread_ = std::jthread([this](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        pollfd poll{listener_.get(), POLLIN, 0};
        std::string remote;
        if (::poll(&poll, 1, 10) > 0) {
          serve(Descriptor(http::accept_from(listener_.get(), remote)));
        }
      }
    });
  }
  [[nodiscard]] std::string origin() const {
    return "https://localhost:" + std::to_string(http::port_of(listener_.get()));
  }
  [[nodiscard]] int taken() const { return taken_; }

 private:
  void serve(const Descriptor& socket) {
    ::fcntl(socket.get(), F_SETFL, 0);  // it may wait
    const Session session(::SSL_new(context_.get()));
    ::SSL_set_fd(session.get(), socket.get());
    std::array<char, 4096> buffer{};
    if (::SSL_accept(session.get()) == 1 && ::SSL_read(session.get(), buffer.data(), buffer.size()) > 0) {
      ++taken_;
      static constexpr std::string_view kTaken = "HTTP/1.1 204 x\r\n\r\n";
      ::SSL_write(session.get(), kTaken.data(), static_cast<int>(kTaken.size()));
      ::SSL_shutdown(session.get());
    }
  }

  Key key_;
  Certificate certificate_;
  Context context_{::SSL_CTX_new(::TLS_server_method())};
  Descriptor listener_ = std::move(http::listen_on("127.0.0.1", 0)).value();
  std::atomic<int> taken_ = 0;
  std::jthread thread_;
};

class CallbackTls : public testing::Test {
 protected:
  void SetUp() override { std::signal(SIGPIPE, SIG_IGN); }  // OpenSSL writes to sockets that are closed
  void TearDown() override { ::unsetenv("SSL_CERT_FILE"); }
  static int status(const TlsReceiver& receiver) {
    return Poster(receiver.origin(), kPatience).post("/", "{}", {}).status;
  }
  TempDir folder_;
  const std::string certificate_ = folder_.file("certificate.pem");
};

TEST_F(CallbackTls, ACertificateThatTheSystemTrustsForTheHostIsTaken) {
  const TlsReceiver receiver("localhost", certificate_);
  ::setenv("SSL_CERT_FILE", certificate_.c_str(), 1);
  EXPECT_EQ(status(receiver), 204);
  EXPECT_EQ(receiver.taken(), 1);
}

TEST_F(CallbackTls, ACertificateThatNobodySignedIsRefusedBeforeAnythingIsSent) {
  const TlsReceiver receiver("localhost", certificate_);
  EXPECT_EQ(status(receiver), 0);
  EXPECT_EQ(receiver.taken(), 0);
}

TEST_F(CallbackTls, ATrustedCertificateOfAnotherHostIsRefused) {
  const TlsReceiver receiver("other.example", certificate_);
  ::setenv("SSL_CERT_FILE", certificate_.c_str(), 1);
  EXPECT_EQ(status(receiver), 0);
  EXPECT_EQ(receiver.taken(), 0);
}

}  // namespace
}  // namespace snapthrough::server::test
