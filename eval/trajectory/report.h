#pragma once
#include <placegraph/eval/trajectory/result.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// One result as JSON, an object with the keys of `metrics()` (null where there is no value) and
/// frames, posed, align, scale, association, lengths_m, step, path_m, lost_frames, per_length,
/// per_speed, outcome, warnings. Ends with a newline, as all of these.
std::string to_json(const EvaluationResult& result);

/// Several as {"results": [...]}, with "average" (and how it was taken) if `with_average`.
std::string to_json(const std::vector<EvaluationResult>& results, bool with_average);

/// One number a line: name,record,key,value,unit,first_frame,last_frame,length_m,speed_m_per_s,
/// protocol. Records are "metric" and "segment" (every segment's t_rel and r_rel); columns that do
/// not apply are empty, and so is a value that the data did not allow.
std::string to_csv(const std::vector<EvaluationResult>& results);

/// A booktabs table, one row per result; the caption states the protocol of the first.
std::string to_latex(const std::vector<EvaluationResult>& results);

/// One result for people: figures, protocol, tables per segment length and per speed.
std::string to_text(const EvaluationResult& result);

/// A comparison, one row per result, and below it the averages if `with_average`.
std::string to_table(const std::vector<EvaluationResult>& results, bool with_average);

}  // namespace placegraph
