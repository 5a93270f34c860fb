#pragma once
#include <placegraph/frontend/places/recognition_options.h>

#include <memory>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

class ImageDescriber;
class PlaceRetrieval;

/// Opens a recognizer by its name: a program, a network, or a file of descriptors.
///
/// `exec:COMMAND`, `onnx:FILE[?KEY=VALUE&...]` or `descriptors:FILE.npy` (docs/recognizers.md).
/// `exec:` starts the command with the first image, as the user who runs this process: pass only
/// what the user has said in this very call, never a text of a file. Throws ArgumentError for
/// another name, FileError for a file that cannot be used; what its descriptors are used for is
/// said by make_recognizer.
std::shared_ptr<ImageDescriber> open_describer(const std::string& name,
                                               const DescriberOptions& options = {});

/// A recognizer that compares images by their descriptors, or by these and cues.
///
/// With DescriberOptions::beside the score of an image is the sum of what both say, each relative
/// to the similarities of images of different places, which are learned from the images
/// themselves. `cues`: options of the cues; those that are not named have no weight. Throws
/// ArgumentError for a name that is no cue.
std::shared_ptr<PlaceRetrieval> make_recognizer(std::shared_ptr<ImageDescriber> describer,
                                                const DescriberOptions& options,
                                                const PlaceRecognizerOptions& cues);

/// Throws ArgumentError if options of a file or of settings name a recognizer.
///
/// `source` names them in the message. A file that comes from somebody else must start no program.
void require_no_recognizer(const DescriberOptions& options, const std::string& source);
/// Throws FileError if a saved map was begun with a recognizer, and none is given now.
///
/// `begun`: options in the map, `path`: its file. The message names the recognizer.
void require_recognizer_again(const DescriberOptions& begun, const std::string& path, bool given);

}  // namespace placegraph
