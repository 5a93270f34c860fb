#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/trajectories/repeated_rows.h>

namespace placegraph {

std::string repeated_rows_warning(const std::string& path, const std::vector<StampedPose>& kept,
                                  const std::vector<RepeatedStamp>& left_out) {
  if (left_out.size() > kept.size())
    throw FileError(path, static_cast<int>(left_out.front().row),
                    fmt::format("{} of {} lines have the time of the line before: have the times "
                                "lost digits?",
                                left_out.size(), left_out.size() + kept.size()));
  return repeated_stamps_warning(path + ":", kept, left_out);
}

}  // namespace placegraph
