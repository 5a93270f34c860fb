#include <fmt/format.h>
#include <placegraph/eval/kitti/kitti_result.h>

namespace placegraph {

std::string to_string(const KittiFault& fault) {
  return fault.line > 0 ? fmt::format("{}:{}: {}", fault.file, fault.line, fault.text)
                        : fmt::format("{}: {}", fault.file, fault.text);
}

std::size_t KittiBenchmark::faults() const {
  std::size_t count = 0;
  for (const KittiSystem& system : systems) count += system.faults.size();
  return count;
}

}  // namespace placegraph
