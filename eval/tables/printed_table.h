#pragma once
#include <placegraph/eval/tables/figure_table.h>

#include <string>
#include <vector>

namespace placegraph {

/// A cell as all texts show it.
struct PrintedCell {
  std::string number;    ///< "0.553", "120/240"; empty: there is no figure
  std::string interval;  ///< "[0.501, 0.610]"; empty: none
  bool best = false;
  std::size_t note = 0;  ///< number of its note, from 1; 0: none
};

/// Columns that share a heading.
struct PrintedGroup {
  std::string heading;  ///< group and unit; empty: none above these columns
  std::size_t first = 0, count = 0;
};

/// A table whose numbers are rounded and whose notes are numbered.
struct PrintedTable {
  std::vector<std::string> headings;  ///< of the columns, with units where no group has them
  std::vector<PrintedGroup> groups;   ///< all columns; none if no column has a group
  std::vector<std::vector<PrintedCell>> cells;
  std::vector<std::string> notes;  ///< those of the cells; equal ones have one number
};

/// Throws ArgumentError as FigureTable::check().
PrintedTable printed(const FigureTable& table);

/// Whether two columns have one heading and figures of one kind.
bool same_group(const TableColumn& a, const TableColumn& b);

/// "name [unit]", or the name alone.
std::string with_unit(const std::string& name, const std::string& unit);

/// The decimals of every column: as said, or for three digits of the smallest value of its group
/// and for two of the narrowest half interval, whichever are more; not more than 4 unless all
/// values are small.
std::vector<int> decimals_of_columns(const FigureTable& table);

/// A value with so many decimals; with an exponent where these would round it by more than a
/// tenth, and from 1e12 on.
std::string number_text(double value, int decimals);

}  // namespace placegraph
