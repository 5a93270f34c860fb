#pragma once
#include <placegraph/pipeline/run.h>

#include <nlohmann/json_fwd.hpp>

namespace placegraph {

/// Whether lengths are metres, by result.json of a run: its judgement says it, or where an earlier
/// program wrote none, the file itself.
bool metric_of(const nlohmann::json& result);

/// The judgement for result.json: verdict, metric, why_metric, and findings with cause, text,
/// advice.
nlohmann::json describe_judgement(const Judgement& judgement);

}  // namespace placegraph
