#include <placegraph/pipeline/internal/health/health_monitor.h>

namespace placegraph {

void HealthMonitor::add(const Frame& frame) { repeated_.add(frame); }

std::vector<DataNote> HealthMonitor::notes() const {
  std::vector<DataNote> notes;
  const auto collect = [&](const std::optional<DataNote>& note) {
    if (note) notes.push_back(*note);
  };
  collect(repeated_.note());
  return notes;
}

}  // namespace placegraph
