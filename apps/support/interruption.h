#pragma once
#include <csignal>

namespace placegraph::apps {

/// Notices the signals by which a user ends a program (SIGINT, SIGTERM, SIGHUP), while it exists.
/// The first signal is only noted; a second one, of any of them, ends the process. A signal that
/// the process ignores, as SIGHUP under nohup, stays ignored. One object at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Whether a signal has arrived.
  bool requested() const;

 private:
  struct sigaction before_[3];
};

}  // namespace placegraph::apps
