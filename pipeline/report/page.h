#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace placegraph::report {

/// The page of web/dist/report.html, which is part of the library, without data.
std::string_view empty_page();

/// The page with its data. What is text in the data cannot end the script or begin a tag: every "<"
/// is escaped, and bytes that are no UTF-8 are replaced.
std::string page_with(const nlohmann::json& data);

}  // namespace placegraph::report
