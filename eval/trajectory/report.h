#pragma once
#include <placegraph/eval/trajectory/result.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Writes one result as a JSON object.
///
/// It has the keys of `metrics()` (null where there is no value) and frames, posed, align, scale,
/// association, lengths_m, step, path_m, lost_frames, per_length, per_speed, outcome, warnings and
/// others. Ends with a newline, as all of these.
std::string to_json(const EvaluationResult& result);

/// Writes several results as {"results": [...]}, with "average" if `with_average`.
///
/// `missing` sequences have no estimate, and leave no mean over all. `common`, if not empty, are those of the frames that all have, and are written as "common".
std::string to_json(const std::vector<EvaluationResult>& results, bool with_average,
                    const std::vector<EvaluationResult>& common = {}, int missing = 0);

/// Writes results as CSV with one number per line and a header.
///
/// Columns: name,record,key,value,unit,first_frame,last_frame,length_m,speed_m_per_s,protocol.
/// Records are "metric" and "segment" (every segment's t_rel and r_rel). Columns that do not apply
/// and values that the data did not allow are empty.
std::string to_csv(const std::vector<EvaluationResult>& results);

/// Writes a LaTeX table (booktabs), one row per result; empty without results.
///
/// The caption states the protocol of the first result.
std::string to_latex(const std::vector<EvaluationResult>& results);

/// Writes one result for people: figures, protocol, tables per segment length and per speed.
std::string to_text(const EvaluationResult& result);

/// Writes a comparison for people, one row per result, and the averages if `with_average`.
std::string to_table(const std::vector<EvaluationResult>& results, bool with_average,
                     int missing = 0);

}  // namespace placegraph
