#include <placegraph/graph/image/png_codec.h>
#include <placegraph/io/map/map_columns.h>
#include <placegraph/io/map/run_reader.h>

namespace placegraph {
namespace {

constexpr const char* kNoteColumns = "number, cause, text, doubts_scale, advice";

/// The note of a row of kNoteColumns.
DataNote note_of(const SqliteRows& rows) {
  const auto cause = note_cause_of(rows.text(1));
  if (!cause) rows.refuse("cause: not a cause: " + std::string(rows.text(1)));
  return {std::string(rows.text(2)), rows.integer(3, 0, 1) == 1, *cause,
          std::string(rows.text(4))};
}

}  // namespace

void read_judgement(SqliteDatabase& database, StoredMap& stored) {
  SqliteRows rows(database, "judgement", "id, verdict, metric, why_metric, expected_drift_m");
  if (!rows.next()) return;
  Judgement& judgement = stored.judgement.emplace();
  const auto verdict = verdict_of(rows.text(1));
  if (!verdict) rows.refuse("verdict: not a verdict: " + std::string(rows.text(1)));
  judgement.verdict = *verdict;
  judgement.metric = rows.integer(2, 0, 1) == 1;
  judgement.why_metric = rows.text(3);
  // Earlier programs left the metres to the map that a judgement had withdrawn.
  stored.map.metric = judgement.metric;
  if (judgement.metric && !rows.is_null(4)) judgement.expected_drift_m = rows.real(4);
  SqliteRows findings(database, "finding", kNoteColumns);
  while (findings.next()) {
    require_next(findings, judgement.findings.size());
    judgement.findings.push_back(note_of(findings));
  }
}

void read_run(SqliteDatabase& database, StoredMap& stored) {
  RunRecord& run = stored.run;
  SqliteRows notes(database, "note", kNoteColumns);
  while (notes.next()) {
    require_next(notes, run.notes.size());
    run.notes.push_back(note_of(notes));
  }
  SqliteRows errors(database, "odometry_error", "id, independent, shared");
  if (errors.next())
    run.odometry_error = {symmetric_column(errors, 1, "independent", 6),
                          symmetric_column(errors, 2, "shared", 6)};
  SqliteRows stages(database, "stage", "number, name, cpu_s, calls");
  while (stages.next()) {
    require_next(stages, run.stages.size());
    run.stages.push_back({std::string(stages.text(1)), stages.real(2), stages.integer(3, 0)});
  }
}

void read_overlays(SqliteDatabase& database, MapOrigin& origin) {
  auto& overlays = origin.overlays;
  SqliteRows rows(database, "overlay", std::string(kNoteColumns) + ", mask");
  while (rows.next()) {
    require_next(rows, overlays.size());
    overlays.push_back({decode_png(rows.blob(5), DecodedPixels::kAsStored), note_of(rows)});
    const Image& mask = overlays.back().mask;
    if (mask.empty() || mask.type() != CV_8UC1) rows.refuse("mask: is no grey image");
  }
}

}  // namespace placegraph
