#include "apps/server/plugin/connections.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdlib>
#include <filesystem>
#include <set>

namespace placegraph::apps {
namespace {

/// A request must be complete after this time.
constexpr std::chrono::seconds kMostReading(10);
/// Connections that come after the end are soon shut down.
constexpr std::chrono::milliseconds kBetweenChecksAtEnd(20);

int port_of(const sockaddr_in& address) { return ntohs(address.sin_port); }

/// The connections of this process to a port: descriptors and ports of the peers.
std::vector<std::pair<int, int>> connections_to(int port) {
  std::vector<std::pair<int, int>> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    const int descriptor = std::atoi(entry.path().filename().c_str());
    sockaddr_in own{}, peer{};
    socklen_t own_size = sizeof own, peer_size = sizeof peer;
    if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&own), &own_size) != 0 ||
        own.sin_family != AF_INET || port_of(own) != port)
      continue;
    if (getpeername(descriptor, reinterpret_cast<sockaddr*>(&peer), &peer_size) == 0)
      found.emplace_back(descriptor, port_of(peer));
  }
  return found;
}

}  // namespace

Connections::~Connections() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Connections::guard(int port) {
  thread_ = std::thread([this, port] { watch(port); });
}

void Connections::watch(int port) {
  std::unique_lock lock(mutex_);
  while (!ended_) {
    lock.unlock();
    const auto open = connections_to(port);
    lock.lock();
    check(open);
    const bool closing = closing_;
    changed_.wait_for(lock, closing ? kBetweenChecksAtEnd : between_checks_,
                      [&] { return ended_ || closing_ != closing; });
  }
}

void Connections::begin_response(int peer_port) {
  const std::lock_guard lock(mutex_);
  peers_[peer_port] = {true, Clock::now()};
}

void Connections::end_response(int peer_port) {
  const std::lock_guard lock(mutex_);
  peers_[peer_port] = {false, Clock::now()};
}

/// Shuts down what is due of the open connections; the caller has locked.
void Connections::check(const std::vector<std::pair<int, int>>& open) {
  const auto now = Clock::now();
  std::set<int> present;
  for (const auto& [descriptor, peer_port] : open) {
    present.insert(peer_port);
    const Peer& peer = peers_.try_emplace(peer_port, Peer{false, now}).first->second;
    if (closing_ || (!peer.responding && now - peer.since > kMostReading))
      ::shutdown(descriptor, SHUT_RDWR);
  }
  std::erase_if(peers_, [&](const auto& peer) { return !present.contains(peer.first); });
}

void Connections::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
}

}  // namespace placegraph::apps
