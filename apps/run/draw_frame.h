#pragma once
#include <placegraph/graph/image/frame.h>
#include <placegraph/pipeline/cues/frame_view.h>
#include <placegraph/pipeline/slam.h>

#include <string>

namespace placegraph::apps {

/// The frame as the system sees it: every track with its way from the frame before, landmarks from
/// green (on their pixel) to red (3 px off), points without depth white, lines likewise, the ground
/// outlined in blue, pixels of aligned surfaces from green to red (3 standard deviations off). BGR,
/// of the frame's size.
Image draw_frame(const Frame& frame, const FrameResult& result, const FrameView& view);

/// Writes it as `folder`/NNNNNN.png, by the frame's number. Throws FileError.
void write_frame_drawing(const std::string& folder, const Frame& frame, const FrameResult& result,
                         const FrameView& view);

}  // namespace placegraph::apps
