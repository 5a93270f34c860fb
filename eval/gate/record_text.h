#pragma once
#include <placegraph/eval/gate/record.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// The version of the format that to_json() writes.
inline constexpr int kRecordVersion = 1;

/// A record as JSON: a line for each figure, so that a version control shows what changed.
/// Throws as Record::check().
std::string to_json(const Record& record);

/// Reads what to_json() writes; `source` is the file's name in messages.
///
/// Throws FileError, one line with the place, for text that is no JSON, another format or version,
/// an unknown or repeated key, a value of another type, and what Record::check() refuses.
[[nodiscard]] Record parse_record(const std::string& text, const std::string& source);

}  // namespace placegraph
