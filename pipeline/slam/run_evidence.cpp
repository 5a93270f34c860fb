#include <placegraph/graph/core/error.h>
#include <placegraph/graph/state_archive.h>
#include <placegraph/pipeline/slam/run_evidence.h>

namespace placegraph {
namespace {

/// Version of the bytes; another one cannot be read.
constexpr std::uint8_t kEvidenceVersion = 3;

void visit_sources(auto& archive, const RunEvidence& sources) {
  archive(sources.environments, sources.odometry, sources.links, sources.health,
          sources.contradicted);
  if (sources.overlay) archive(*sources.overlay);
}

}  // namespace

std::string evidence_of(const RunEvidence& sources, std::optional<FrameId> newest) {
  StateWriter writer;
  std::uint8_t version = kEvidenceVersion, with_overlay = sources.overlay.has_value();
  writer(version, with_overlay, newest);
  visit_sources(writer, sources);
  return writer.written();
}

std::optional<FrameId> take_up_evidence(const std::string& evidence, const RunEvidence& sources,
                                        const Frame& last) {
  if (evidence.empty()) return std::nullopt;
  StateReader reader(evidence);
  std::uint8_t version = 0, with_overlay = 0;
  std::optional<FrameId> newest;
  reader(version, with_overlay, newest);
  require(version == kEvidenceVersion,
          "the interrupted run is one of another version of the program");
  require((with_overlay != 0) == sources.overlay.has_value(),
          "the interrupted run has other options of static overlays");
  visit_sources(reader, sources);
  reader.end();
  if (newest == last.id) sources.health.go_on_after(last);
  return newest;
}

std::vector<EnvironmentObservation> environments_in(const std::string& evidence) {
  std::vector<EnvironmentObservation> observations;
  if (evidence.empty()) return observations;
  StateReader reader(evidence);
  std::uint8_t version = 0, with_overlay = 0;
  reader(version);
  if (version != kEvidenceVersion) return observations;
  std::optional<FrameId> newest;
  reader(with_overlay, newest, observations);
  return observations;
}

}  // namespace placegraph
