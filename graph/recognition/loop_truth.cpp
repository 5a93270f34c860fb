#include <placegraph/graph/core/error.h>
#include <placegraph/graph/recognition/loop_truth.h>

namespace placegraph {

std::string to_string(LoopProtocol protocol) {
  switch (protocol) {
    case LoopProtocol::kUndecided:
      return "undecided";
    case LoopProtocol::kWithinDrive:
      return "within one drive";
    case LoopProtocol::kQueryDatabase:
      return "queries against a database";
  }
  throw ArgumentError("unknown protocol");
}

LoopTruth loop_truth_of_matrix(const std::vector<bool>& matches, std::size_t columns) {
  require(columns > 0 && matches.size() % columns == 0,
          "loop_truth_of_matrix: the matches are no matrix of these columns");
  LoopTruth truth;
  const std::size_t rows = matches.size() / columns;
  for (std::size_t q = 0; q < rows; ++q) {
    LoopQuery query;
    if (rows != columns) query.last = FrameId(static_cast<std::int64_t>(columns) - 1);
    for (std::size_t m = 0; m < columns; ++m) {
      if (!matches[q * columns + m]) continue;
      query.matches.push_back(FrameId(static_cast<std::int64_t>(m)));
    }
    truth.queries.emplace(FrameId(static_cast<std::int64_t>(q)), std::move(query));
  }
  truth.protocol = rows != columns ? LoopProtocol::kQueryDatabase : LoopProtocol::kUndecided;
  return truth;
}

}  // namespace placegraph
