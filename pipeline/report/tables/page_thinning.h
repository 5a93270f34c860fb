#pragma once
#include <cstddef>
#include <nlohmann/json_fwd.hpp>

namespace placegraph::report {

/// Bytes of the data of a page, without images and their points, that no number of poses exceeds.
inline constexpr std::size_t kMostPageBytes = 300'000;
/// The same for the page of a run, whose landmarks are a cloud that is looked at from nearby.
inline constexpr std::size_t kMostRunPageBytes = 2'000'000;

/// Leaves rows of the tables of runs and graphs out if a report has more than so many bytes.
///
/// Tables are thinned to the same number of bytes each, what small ones leave is for the others.
/// Frames stay as chosen_rows() chooses them, with those of loops, or without loops of
/// keyframes, as far as half of them allows. Keyframes stay with their frames. Places and nodes
/// that are left out are joined with the one before, and so are the ends of their edges. Of
/// landmarks every n-th stays, of loops first what counts, then the others evenly. Notes say how
/// many of how many are drawn; figures, counts and the path length remain those of all.
void thin_report(nlohmann::json& report, std::size_t most = kMostPageBytes);

}  // namespace placegraph::report
