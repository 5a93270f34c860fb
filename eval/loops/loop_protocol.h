#pragma once
#include <placegraph/graph/recognition/loop_prediction.h>
#include <placegraph/graph/recognition/loop_truth.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What a user says of the candidates of queries; nothing: truth and predictions decide.
struct LoopProtocolChoice {
  std::optional<bool> within;           ///< true: one drive; false: queries against a database
  std::optional<std::int64_t> min_age;  ///< smallest age of a candidate, in images
};

/// Sets the protocol of a truth as its user says.
///
/// An age above 0 means one drive, and 0 queries against a database, unless `within` says otherwise
/// or the truth lists the candidates of its queries. `age_of_drive` is that of candidates within one
/// drive where none is chosen and the truth does not list them [images]. Throws ArgumentError for a
/// negative age, an age of a database's images, and for a truth of two sets that is said to be of one
/// drive.
void choose_protocol(LoopTruth& truth, const LoopProtocolChoice& choice,
                     std::int64_t age_of_drive);

/// The protocol by which predictions are judged.
///
/// A truth that is undecided is of one drive if it has no match that is not older than its query, or
/// no prediction has such a candidate. Else it is of two sets if fewer than half of its pairs are
/// listed both ways, as those of one drive are. Throws ArgumentError if it may be either.
LoopProtocol protocol_of(const LoopTruth& truth, const std::vector<LoopPrediction>& predictions);

}  // namespace placegraph
