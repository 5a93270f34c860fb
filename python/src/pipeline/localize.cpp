#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/pipeline/map/map_file.h>
#include <placegraph/pipeline/map/map_localizer.h>

#include <memory>

#include "python/src/graph/ids.h"
#include "python/src/graph/images.h"
#include "python/src/graph/maps.h"
#include "python/src/options.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

/// A frame of an array, or one of a dataset. Colour is converted to grey as readers do it.
Frame query_frame(nb::handle image, std::size_t i) {
  if (Frame frame; nb::try_cast<Frame>(image, frame)) return frame;
  const std::string argument = "images[" + std::to_string(i) + "]";
  Frame frame;
  frame.id = FrameId(static_cast<std::int64_t>(i));
  if (nb::hasattr(image, "ndim") && nb::cast<int>(image.attr("ndim")) == 3) {
    frame.colour = colour_image(image, argument.c_str());
    frame.image = to_grey(frame.colour);
  } else {
    frame.image = grey_image(image, argument.c_str());
  }
  return frame;
}

std::vector<Localization> localize(const MapLocalizer& localizer,
                                   const nb::typed<nb::list, nb::any>& images, bool sequence,
                                   const nb::object& on_image) {
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < images.size(); ++i) frames.push_back(query_frame(images[i], i));
  const WithoutGil released;
  return localizer.localize(
      frames.size(),
      [&](std::size_t i) {
        if (!on_image.is_none()) {
          const nb::gil_scoped_acquire gil;
          on_image(i);
        }
        return frames[i];
      },
      sequence);
}

}  // namespace

void bind_localize(nb::module_& m) {
  nb::class_<Localization>(m, "Localization", doc("Localization"))
      .def_ro("placed", &Localization::placed, doc("Localization::placed"))
      .def_ro("place", &Localization::place, doc("Localization::place"))
      .def_ro("keyframe", &Localization::keyframe, doc("Localization::keyframe"))
      .def_ro("frame", &Localization::frame, doc("Localization::frame"))
      .def_ro("probability", &Localization::probability, doc("Localization::probability"))
      .def_ro("stage", &Localization::stage, doc("Localization::stage"))
      .def_ro("T_map_cam", &Localization::T_map_cam, doc("Localization::T_map_cam"))
      .def_ro("without_pose", &Localization::without_pose, doc("Localization::without_pose"))
      .def("__repr__", [](const Localization& l) {
        return "<placegraph.Localization: " +
               (l.placed ? "place " + std::to_string(l.place->value()) + " by " + l.stage
                         : "refused by " + l.stage) +
               (l.T_map_cam ? ", with a pose>" : ", without a pose>");
      });
  m.def(
      "localizer_options",
      [](const StoredMap& stored) {
        return std::make_unique<OptionSetOf<LocalizerOptions>>(
            localizer_options_of("map", stored.origin));
      },
      "map"_a, "Options for a map: cues of its views, and the loop options of its run.");
  nb::class_<MapLocalizer>(m, "MapLocalizer", doc("MapLocalizer"))
      .def(
          "__init__",
          [](MapLocalizer* self, const StoredMap& stored, const OptionSet& options) {
            const auto& typed = options_in<LocalizerOptions>(options, "options");
            const WithoutGil released;
            new (self) MapLocalizer(typed, stored);
          },
          "map"_a, "options"_a, doc("MapLocalizer::MapLocalizer"))
      .def("localize", &localize, "images"_a, "sequence"_a = false, "on_image"_a = nb::none(),
           "Localizes a list of images: arrays, or frames of a dataset.\n\n"
           "`on_image` is called with the number of each before it is compared.");
}

}  // namespace placegraph::python
