#pragma once
#include <placegraph/frontend/internal/places/code_database.h>
#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/frontend/places/sequence_filter.h>
#include <placegraph/graph/loop_prediction.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

struct MatchOptions {
  PlaceRecognizerOptions recognizer;
  PlaceCodeOptions codes;
  SequenceFilterOptions sequence;
  void check() const;
};
void visit(OptionVisitor& field, MatchOptions& options);

/// The cues of two views that are compared.
const std::vector<std::string>& match_cues();
/// What views are compared by: "cues", or visual words in the order of PlaceCode.
const std::vector<std::string>& match_codes();

struct MatchArguments {
  std::string folder;  ///< of images; gt.txt in it names the candidates of each query
  std::string out;     ///< file of the answers
  std::string codes = match_codes().front();
  std::string vocabulary;                        ///< words of train_vocabulary; empty: none
  std::vector<std::string> cues = match_cues();  ///< those that count
  /// Every image is compared with those at least so many older, whatever gt.txt says; where there
  /// is none, 300.
  std::optional<int> min_age;
  bool sequence = false;              ///< the evidence of the images before each query is added
  std::vector<std::string> settings;  ///< "key=value", above `options`
  MatchOptions options;
  bool force = false;  ///< overwrite `out`
};

struct MatchResult {
  std::string out;
  std::size_t images = 0, queries = 0;
  std::vector<LoopPrediction> found;  ///< one a query that has an answer
  double cpu_ms_an_image = 0;
};

/// `placegraph match`: finds for each image the older one that shows the same place and writes
/// them. Progress and warnings go to stderr. Throws ArgumentError, FileError, and NoAnswer where no
/// query has an answer; then nothing is written.
MatchResult match(const MatchArguments& arguments);

/// One line.
std::string to_text(const MatchResult& result);

}  // namespace placegraph::apps
