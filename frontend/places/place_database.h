#pragma once
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/frontend/places/vocabulary.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/place_graph.h>

#include <functional>
#include <unordered_map>
#include <vector>

namespace placegraph {

struct PlaceCandidate {
  KeyframeId id;
  double score = 0;  ///< [0, 1]: sum over common words of the smaller weight
};

/// Database of views, one per keyframe, described by visual words.
///
/// No file is needed: the vocabulary is trained from the views themselves, again whenever their
/// number has doubled, and all views are then described with the new words. Retrieval by tf-idf
/// (Sivic & Zisserman 2003) with an inverted index.
class PlaceDatabase {
 public:
  PlaceDatabase(const PlaceDatabaseOptions& options, std::uint64_t seed);

  /// Adds a view. Its id must be new.
  void add(KeyframeId id, const std::vector<Feature>& features);
  /// Returns the best `count` views that `allowed` admits, best first; none before the first
  /// training.
  std::vector<PlaceCandidate> query(const std::vector<Feature>& features, int count,
                                    const std::function<bool(KeyframeId)>& allowed) const;
  /// Similarity of given features to one stored view; 0 if unknown or before the first training.
  double similarity(const std::vector<Feature>& features, KeyframeId id) const;
  /// tf-idf weights, L1-normalized; empty before the first training.
  Appearance describe(const std::vector<Feature>& features) const;
  /// Weights of a stored view. Throws ArgumentError for an unknown one.
  const Appearance& appearance(KeyframeId id) const;
  /// Number of views in the last training, after which all views are described again; 0 before the
  /// first.
  std::size_t trained_views() const { return trained_views_; }
  std::size_t size() const { return views_.size(); }

 private:
  struct View {
    KeyframeId id;
    std::vector<BinaryDescriptor> descriptors;
    Appearance appearance;
  };
  void train();
  void index(int view);
  Appearance weigh(const std::vector<BinaryDescriptor>& descriptors) const;

  PlaceDatabaseOptions options_;
  std::uint64_t seed_;
  Vocabulary vocabulary_;
  std::vector<View> views_;
  std::unordered_map<KeyframeId, std::size_t> index_of_;  // index in views_, by id
  std::vector<float> idf_;
  std::vector<std::vector<std::pair<int, float>>> inverted_;  // word -> (view, weight)
  std::size_t trained_views_ = 0;
};

}  // namespace placegraph
