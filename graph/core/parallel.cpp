#include <placegraph/graph/core/parallel.h>

#include <utility>

namespace placegraph {
namespace {

thread_local InterruptionScope* innermost = nullptr;

}  // namespace

InterruptionScope::InterruptionScope(std::function<void()> check)
    : check_(std::move(check)),
      checked_(std::chrono::steady_clock::now()),
      outer_(std::exchange(innermost, this)) {}

InterruptionScope::~InterruptionScope() { innermost = outer_; }

void check_interruption() {
  // Well below the second within which a user expects an answer; a check may wait for a lock.
  constexpr std::chrono::milliseconds kBetween(100);
  InterruptionScope* const scope = innermost;
  if (!scope) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - scope->checked_ < kBetween) return;
  scope->checked_ = now;
  scope->check_();
}

}  // namespace placegraph
