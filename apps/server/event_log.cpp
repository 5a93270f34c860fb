#include "apps/server/event_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace placegraph::apps {
namespace {

constexpr std::size_t kMostEvents = 4096, kMostTogether = 256;
/// By a comment after this time the server notices a browser that has gone.
constexpr std::chrono::seconds kHeartbeat(2);

std::string event_text(std::int64_t number, const std::string& name, const std::string& data) {
  return fmt::format("id: {}\nevent: {}\ndata: {}\n\n", number, name, data);
}

}  // namespace

class EventLog::Reader : public HttpStream {
 public:
  Reader(std::shared_ptr<EventLog> log, std::int64_t next) : log_(std::move(log)), next_(next) {}
  ~Reader() override {
    const std::lock_guard lock(log_->mutex_);
    --log_->readers_;
  }
  std::optional<std::string> next() override {
    std::unique_lock lock(log_->mutex_);
    if (!begun_) {
      begun_ = true;
      return event_text(next_ - 1, "joined", "{}");
    }
    log_->changed_.wait_for(lock, kHeartbeat, [&] { return next_ < log_->end() || log_->closed_; });
    if (next_ == log_->end()) {
      if (log_->closed_) return std::nullopt;
      return ": alive\n\n";
    }
    next_ = std::max(next_, log_->first_);
    std::string text;
    for (std::size_t i = 0; i < kMostTogether && next_ < log_->end(); ++i, ++next_)
      text += log_->events_[static_cast<std::size_t>(next_ - log_->first_)];
    return text;
  }

 private:
  std::shared_ptr<EventLog> log_;
  std::int64_t next_;
  bool begun_ = false;
};

std::int64_t EventLog::add(const std::string& name, const std::string& data) {
  const std::lock_guard lock(mutex_);
  const std::int64_t number = end();
  events_.push_back(event_text(number, name, data));
  if (events_.size() > kMostEvents) {
    events_.pop_front();
    ++first_;
  }
  changed_.notify_all();
  return number;
}

std::int64_t EventLog::last() const {
  const std::lock_guard lock(mutex_);
  return end() - 1;
}

void EventLog::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

std::shared_ptr<HttpStream> EventLog::reader() {
  const std::lock_guard lock(mutex_);
  if (readers_ >= kMostReaders) return nullptr;
  ++readers_;
  visited_ = true;
  return std::make_shared<Reader>(shared_from_this(), end());
}

bool EventLog::visited() const {
  const std::lock_guard lock(mutex_);
  return visited_;
}

int EventLog::readers() const {
  const std::lock_guard lock(mutex_);
  return readers_;
}

}  // namespace placegraph::apps
