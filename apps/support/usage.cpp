#include "apps/support/usage.h"

#include <sys/resource.h>

namespace placegraph::apps {

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace placegraph::apps
