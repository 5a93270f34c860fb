#pragma once
#include <placegraph/eval/drawing/picture_legend.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/pipeline/cues/frame_view.h>
#include <placegraph/pipeline/slam.h>

#include <vector>

namespace placegraph::apps {

/// Drawing of a frame with its tracks, landmarks, lines, ground and aligned surfaces.
/// Each track is drawn with its motion since the previous frame. Landmarks and lines go from green
/// (no error) to red (3 px), points without depth are white. The ground is outlined in blue. Pixels
/// of aligned surfaces go from green to red (3 standard deviations). BGR, of the frame's size.
Image draw_frame(const Frame& frame, const FrameResult& result, const FrameView& view);

/// What the colours of these drawings mean.
std::vector<LegendEntry> frame_legend();

}  // namespace placegraph::apps
