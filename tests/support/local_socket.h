#pragma once
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace placegraph::test {

/// A TCP socket on 127.0.0.1, closed with the object.
class LocalSocket {
 public:
  explicit LocalSocket(int descriptor) : descriptor_(descriptor) {
    if (descriptor_ < 0) throw std::runtime_error("no socket");
  }
  LocalSocket(LocalSocket&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  LocalSocket& operator=(LocalSocket&&) = delete;
  ~LocalSocket() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  /// Listens on a free port.
  static LocalSocket listener() {
    LocalSocket socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const sockaddr_in address = address_of(0);
    if (::bind(socket.descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address) ||
        ::listen(socket.descriptor_, 16))
      throw std::runtime_error("no free port");
    return socket;
  }
  static LocalSocket connected(int port) {
    LocalSocket socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const sockaddr_in address = address_of(port);
    if (::connect(socket.descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address))
      throw std::runtime_error("nobody listens on port " + std::to_string(port));
    return socket;
  }
  LocalSocket accept() const { return LocalSocket(::accept(descriptor_, nullptr, nullptr)); }

  int port() const {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    ::getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.sin_port);
  }
  /// False if the connection is closed.
  bool send(std::string_view bytes) const {
    return ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(bytes.size());
  }
  /// The next bytes; empty at the end of the connection. Throws if nothing comes at all.
  std::string receive() const {
    const timeval longest{60, 0};
    ::setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
    char bytes[4096];
    const ssize_t count = ::recv(descriptor_, bytes, sizeof bytes, 0);
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK))
      throw std::runtime_error("the connection neither ends nor goes on");
    return {bytes, static_cast<std::size_t>(count > 0 ? count : 0)};
  }
  /// All bytes up to the end of the connection.
  std::string receive_all() const {
    std::string all;
    for (std::string bytes = receive(); !bytes.empty(); bytes = receive()) all += bytes;
    return all;
  }

 private:
  static sockaddr_in address_of(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    return address;
  }
  int descriptor_;
};

/// The whole answer of a server on this port to a request, "GET /path" with these header lines.
inline std::string answer_of(int port, const std::string& request, const std::string& headers = "",
                             const std::string& content = "") {
  const LocalSocket socket = LocalSocket::connected(port);
  std::string text = request + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
                     "\r\nConnection: close\r\n" + headers;
  if (!content.empty()) text += "Content-Length: " + std::to_string(content.size()) + "\r\n";
  socket.send(text + "\r\n" + content);
  return socket.receive_all();
}

/// What follows the head of an answer.
inline std::string content_of(const std::string& answer) {
  const std::size_t end = answer.find("\r\n\r\n");
  return end == std::string::npos ? std::string() : answer.substr(end + 4);
}

}  // namespace placegraph::test
