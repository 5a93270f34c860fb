#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace placegraph::apps {

/// The page of web/dist/report.html, which is part of the program, without data.
std::string_view empty_page();

/// The page with its data. What is text in the data cannot end the script or begin a tag: every "<"
/// is escaped, and bytes that are no UTF-8 are replaced.
std::string page_with(const nlohmann::json& data);

/// The page for a server; `start` says what it shows. Only scripts with `nonce`, a random text
/// of letters and digits, run in it, by the content security policy that the server sends.
std::string page_served(const nlohmann::json& start, const std::string& nonce);

}  // namespace placegraph::apps
