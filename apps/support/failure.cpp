#include "apps/support/failure.h"

#include <placegraph/graph/core/error.h>

#include <filesystem>
#include <new>

#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

template <class Kind>
bool is_kind(const std::exception& error) {
  return dynamic_cast<const Kind*>(&error) != nullptr;
}

}  // namespace

Failure failure_of(const std::exception& error) {
  if (is_kind<NoResult>(error)) return {ExitCode::kNoResult, error.what()};
  if (is_kind<Interrupted>(error)) return {ExitCode::kInterrupted, error.what()};
  if (is_kind<Error>(error) || is_kind<std::filesystem::filesystem_error>(error))
    return {ExitCode::kUsage, error.what()};
  if (is_kind<std::bad_alloc>(error)) return {ExitCode::kInternal, "there is not enough memory"};
  return {ExitCode::kInternal,
          std::string("internal error, please report it with the command: ") + error.what()};
}

}  // namespace placegraph::apps
