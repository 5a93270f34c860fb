#pragma once
#include <string>

namespace placegraph::apps {

struct EvalArguments;
struct EvalResult;
struct LoopsArguments;
struct LoopsResult;
struct OptimizeArguments;
struct OptimizeResult;

/// Name and version of the program.
inline constexpr const char* kProgram = "placegraph " PLACEGRAPH_VERSION;

// The pages of `--report`, from results of commands that do not know how a page is made.
// Each throws FileError if the page cannot be written.
void write_optimize_page(const OptimizeArguments& arguments, const OptimizeResult& result);
void write_eval_page(const EvalArguments& arguments, const EvalResult& result);
void write_loops_page(const LoopsArguments& arguments, const LoopsResult& result);

/// Writes the page of the run in a folder, if the run has a map, and replaces an earlier one.
void write_folder_page(const std::string& folder, const std::string& file);

}  // namespace placegraph::apps
