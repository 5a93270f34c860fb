#pragma once
#include <placegraph/eval/gate/gate.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// A gate's result for people: the verdict, a table, and a sentence for each figure that has one.
/// `everything`: figures that are the same to the digit and those that are told stand in it, too.
std::string to_text(const GateResult& result, bool everything = true);

/// All of a gate's result as JSON.
std::string to_json(const GateResult& result);

/// A page for a pull request: a short table, what regressed first; the rest is folded.
std::string to_markdown(const GateResult& result);

/// JUnit's XML, one test case for each figure: a failure where it regressed, an error where it
/// cannot be judged. Characters that XML does not allow become question marks.
std::string to_junit(const GateResult& result);

}  // namespace placegraph
