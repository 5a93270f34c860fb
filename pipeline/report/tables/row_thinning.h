#pragma once
#include <cstddef>
#include <vector>

namespace placegraph::report {

/// A quantity of the rows of a table, drawn over them or as a path.
struct RowSeries {
  std::vector<float> values;  ///< `stride` a row; not a number where there is none
  std::size_t stride = 1;     ///< distance of the values of rows that follow each other
  std::size_t width = 1;      ///< number of values of a row that count
};

/// At most `most` rows of a table that draw its series best, ascending; all if they are few enough.
///
/// The first and the last row, and of those `wanted` (ascending) up to half of the rows, evenly.
/// An eighth is spread evenly. The others are chosen as Douglas and Peucker (1973) choose points of
/// a line, over all series at once: the row that lies farthest from the straight line between kept
/// ones, as a share of the range of its series, is the next. Begins and ends of gaps count as steps
/// of a whole range, so that they and single outliers come first. The time is linear in the number
/// of values. `most` is at least 2.
std::vector<std::size_t> chosen_rows(std::size_t count, const std::vector<RowSeries>& series,
                                     const std::vector<std::size_t>& wanted, std::size_t most);

/// At most `most` of so many rows, evenly, with the first and the last one; ascending.
std::vector<std::size_t> even_rows(std::size_t count, std::size_t most);

}  // namespace placegraph::report
