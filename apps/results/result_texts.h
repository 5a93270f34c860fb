#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace placegraph::apps {

/// The judgement of result.json in lines of text, the first one with the verdict; each ends with a
/// line break and all but the first begin with `indent`.
std::string judgement_text(const nlohmann::json& judgement, const std::string& indent);

/// One line about the components of a map that has several, else an empty text.
std::string components_text(const nlohmann::json& components);

}  // namespace placegraph::apps
