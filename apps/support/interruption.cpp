#include "apps/support/interruption.h"

namespace placegraph::apps {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};
volatile std::sig_atomic_t signal_arrived = 0;

extern "C" void note_signal(int) { signal_arrived = 1; }

}  // namespace

Interruption::Interruption() {
  signal_arrived = 0;
  struct sigaction action = {};
  action.sa_handler = note_signal;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  for (int i = 0; i < 3; ++i) sigaction(kSignals[i], &action, &before_[i]);
}

Interruption::~Interruption() {
  for (int i = 0; i < 3; ++i) sigaction(kSignals[i], &before_[i], nullptr);
}

bool Interruption::requested() const { return signal_arrived != 0; }

}  // namespace placegraph::apps
