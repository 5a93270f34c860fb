#pragma once
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace placegraph::apps {

/// The connections of a server: those that do not complete a request in time are shut down, and all
/// of them when the server ends. The library limits single reads only.
class Connections {
 public:
  /// They are looked at this often; `close` and the end of the object do not wait for it.
  explicit Connections(std::chrono::milliseconds between_checks = std::chrono::milliseconds(500))
      : between_checks_(between_checks) {}
  ~Connections();

  /// Begins to watch the connections to this port, on a thread of its own.
  void guard(int port);
  /// A request of the peer with this port has been read, and the response begins.
  void begin_response(int peer_port);
  /// The response has been sent.
  void end_response(int peer_port);
  /// Shuts down all connections, also those that still come; ends with the object.
  void close();

 private:
  using Clock = std::chrono::steady_clock;
  struct Peer {
    bool responding = false;  // now
    Clock::time_point since;
  };
  void watch(int port);
  void check(const std::vector<std::pair<int, int>>& open);  // descriptors, ports of the peers

  const std::chrono::milliseconds between_checks_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool closing_ = false, ended_ = false;
  std::map<int, Peer> peers_;
  std::thread thread_;
};

}  // namespace placegraph::apps
