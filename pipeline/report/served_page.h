#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/io/map/stored_map.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The page of the reports for a server of data, HTML; `start_json` says what it shows.
/// Only scripts with `nonce`, a random text of letters and digits, run in it, by the content
/// security policy that the server sends.
std::string served_page(const std::string& start_json, const std::string& nonce);

/// A run that a server shows.
struct ServedRun {
  std::string name;                         ///< its name on the page
  std::string path;                         ///< file of its map, beside which are other results
  std::shared_ptr<const StoredMap> stored;  ///< its map
};

/// The data of a page with runs, JSON. `program`: name and version of the program.
/// `log` takes warnings of what is left out. Throws FileError for files beside a map that are
/// broken.
std::string served_runs(const std::string& title, const std::string& program,
                        const std::vector<ServedRun>& runs, const LogSink& log = {});

/// The pixels of a keyframe's landmarks, JSON, with the row of each in the data of its page.
std::string served_observations(const Map& map, const Keyframe& keyframe);

/// Name of a run by the file of its map: that of the folder, or of a map with another name.
std::string name_of_run(const std::string& map_path);

/// A column of the page's data, JSON: little-endian values in base64, `width` of them a row.
/// Throws ArgumentError if the values are no whole number of rows.
std::string column_json(const std::vector<float>& values, int width = 1);
/// The same for integers of 32 bits.
std::string column_json(const std::vector<std::int32_t>& values, int width = 1);
/// The same for bytes.
std::string column_json(const std::vector<std::uint8_t>& values, int width = 1);
/// A column of texts: the different ones, and for every row a position among them.
std::string text_column_json(const std::vector<std::string>& texts);

/// An image as a page embeds it: the URL of a JPEG; CV_8UC1 or CV_8UC3 BGR.
std::string jpeg_url(const Image& image);

/// The bytes of that JPEG.
std::string jpeg_of_page(const Image& image);

}  // namespace placegraph
