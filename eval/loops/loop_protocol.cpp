#include <placegraph/eval/loops/loop_protocol.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>

namespace placegraph {
namespace {

bool lists_candidates(const LoopTruth& truth) {
  return !truth.queries.empty() &&
         std::all_of(truth.queries.begin(), truth.queries.end(),
                     [](const auto& each) { return each.second.last < FrameId::highest(); });
}

/// Share of the pairs of different images that are listed both ways.
double mirrored_share(const LoopTruth& truth) {
  std::size_t pairs = 0, mirrored = 0;
  for (const auto& [id, query] : truth.queries)
    for (const FrameId match : query.matches) {
      if (match == id) continue;
      ++pairs;
      const auto other = truth.queries.find(match);
      mirrored += other != truth.queries.end() &&
                  std::binary_search(other->second.matches.begin(), other->second.matches.end(), id);
    }
  // Matches of equal numbers alone: two sets in step, or one drive whose images match themselves.
  return pairs == 0 ? 1 : static_cast<double>(mirrored) / static_cast<double>(pairs);
}

}  // namespace

void choose_protocol(LoopTruth& truth, const LoopProtocolChoice& choice,
                     std::int64_t age_of_drive) {
  require(choice.min_age.value_or(0) >= 0, "min_age: it must not be negative");
  const bool two_sets = truth.protocol == LoopProtocol::kQueryDatabase;
  require(!two_sets || !(choice.within.value_or(false) || choice.min_age.value_or(0) > 0),
          "the truth is of queries and a database: it has no ages, and is not within one drive");
  const bool listed = lists_candidates(truth);
  if (choice.within)
    truth.protocol = *choice.within ? LoopProtocol::kWithinDrive : LoopProtocol::kQueryDatabase;
  else if (choice.min_age && !(listed && *choice.min_age == 0))
    truth.protocol =
        *choice.min_age > 0 ? LoopProtocol::kWithinDrive : LoopProtocol::kQueryDatabase;
  if (truth.protocol == LoopProtocol::kQueryDatabase) {
    require(choice.min_age.value_or(0) == 0,
            "min_age: the images of a database have none; it is of candidates within one drive");
    truth.min_age = 0;
    return;
  }
  truth.min_age = choice.min_age.value_or(listed ? 0 : age_of_drive);
  if (choice.within && !listed) truth.min_age = std::max<std::int64_t>(truth.min_age, 1);
}

LoopProtocol protocol_of(const LoopTruth& truth, const std::vector<LoopPrediction>& predictions) {
  if (truth.protocol != LoopProtocol::kUndecided) return truth.protocol;
  const bool older_matches = std::all_of(
      truth.queries.begin(), truth.queries.end(), [](const auto& each) {
        return each.second.matches.empty() || each.second.matches.back() < each.first;
      });
  const bool older_candidates =
      std::all_of(predictions.begin(), predictions.end(),
                  [](const LoopPrediction& p) { return p.candidate < p.query; });
  if (older_matches || older_candidates) return LoopProtocol::kWithinDrive;
  if (mirrored_share(truth) < 0.5) return LoopProtocol::kQueryDatabase;
  throw ArgumentError(
      "the truth may be of one drive or of queries and a database, and candidates are not older than "
      "their queries: say which (--within, or --min-age 0 for a database; within=True or False in "
      "Python)");
}

}  // namespace placegraph
