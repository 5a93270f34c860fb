#pragma once
#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <thread>

namespace placegraph::apps {

/// The connections of a server: those that do not complete a request in time are shut down, and all
/// of them when the server ends. The library limits single reads only.
class Connections {
 public:
  Connections() = default;
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
  void check();

  std::atomic<int> port_ = 0;
  std::atomic<bool> closing_ = false, ended_ = false;
  std::mutex mutex_;
  std::map<int, Peer> peers_;
  std::thread thread_;
};

}  // namespace placegraph::apps
