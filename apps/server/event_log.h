#pragma once
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>

#include "apps/server/http_server.h"

namespace placegraph::apps {

/// Server-sent events for any number of browsers.
///
/// Events are numbered from 1 on. Adding one never waits for a reader. A bounded number of events
/// is kept: a reader that falls behind misses some, and knows it by the numbers. The first event of
/// every reader is "joined", with the number of the last event before it joined.
class EventLog : public std::enable_shared_from_this<EventLog> {
 public:
  /// Adds an event, its name and its data in one line, and returns its number.
  std::int64_t add(const std::string& name, const std::string& data);
  /// Number of the newest event; 0 before the first.
  std::int64_t last() const;
  /// Ends all readers after the events that they have not read.
  void close();
  /// Each reader holds a thread of the server.
  static constexpr int kMostReaders = 8;

  /// A reader of the events from now on; null if there are as many as there may be.
  std::shared_ptr<HttpStream> reader();
  /// Number of readers.
  int readers() const;
  /// Whether there has been a reader.
  bool visited() const;

 private:
  class Reader;
  friend class Reader;

  std::int64_t end() const { return first_ + static_cast<std::int64_t>(events_.size()); }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> events_;
  std::int64_t first_ = 1;  // number of the oldest event that is kept
  int readers_ = 0;
  bool closed_ = false, visited_ = false;
};

}  // namespace placegraph::apps
