#pragma once
#include <placegraph/frontend/places/code_database.h>
#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/frontend/places/sequence_filter.h>
#include <placegraph/graph/recognition/loop_prediction.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

struct MatchOptions {
  PlaceRecognizerOptions recognizer;
  PlaceCodeOptions codes;
  SequenceFilterOptions sequence;
  DescriberOptions describer;
  void check() const;
};
void visit(OptionVisitor& field, MatchOptions& options);

/// Names of the descriptions of a view: "cues", or visual words in the order of PlaceCode.
const std::vector<std::string>& match_codes();

struct MatchArguments {
  std::string folder;  ///< folder of images; gt.txt in it lists the candidates of each query
  std::string out;     ///< file for the matches
  std::string codes = match_codes().front();
  std::string vocabulary;  ///< file written by train_vocabulary; empty: none
  std::string recognizer;  ///< recognizer that is not the library's (open_describer); empty: none
  std::vector<std::string> cues;  ///< appearance cues; empty: all, or none beside a recognizer
  /// Smallest age of a candidate, in images; it replaces gt.txt. Without it and gt.txt: 300.
  std::optional<int> min_age;
  bool sequence = false;              ///< add the evidence of the images before each query
  std::vector<std::string> settings;  ///< "key=value"; they override `options`
  MatchOptions options;
  bool force = false;  ///< overwrite `out`
};

struct MatchResult {
  std::string out;
  std::size_t images = 0, queries = 0;
  std::vector<LoopPrediction> found;  ///< one per query with a match
  double cpu_ms_an_image = 0;
};

/// Finds an older image of the same place for each image: `placegraph places match`.
/// The matches are written to a file, progress and warnings go to stderr. Throws ArgumentError,
/// FileError, and NoResult if no query has a match; then nothing is written.
MatchResult match(const MatchArguments& arguments);

/// One line.
std::string to_text(const MatchResult& result);

}  // namespace placegraph::apps
