/** Synthetic pages of evaluations: trajectories alone, and loops that were compared with ground truth. */
import type { Run } from "../src/data/report";
import { column, labels } from "./encode";
import { type SampleOptions, sampleRun } from "./sample";

/** An estimate without a map, in the frame of its ground truth. */
export function sampleEstimate(options: Partial<SampleOptions>): Run {
  const run = sampleRun({ landmarks: 0, loops: false, thumbnails: false, ...options });
  const nothing = column("i32", []);
  return {
    ...run,
    folder: "",
    sensor: null,
    aligned: "se3",
    up: [0, -1, 0],
    summary: { ...run.summary, keyframes: null, places: null, landmarks: null, loops_accepted: null, cpu_s: null, wall_s: null, path_length: null },
    judgement: null,
    options: null,
    camera: null,
    tables: [
      {
        title: "Errors by length",
        protocol: "segments begin at every 10th frame",
        columns: ["Segments", "t_rel [%]"],
        rows: [["100 m", "1.2345"]],
      },
    ],
    frame_series: [{ column: "series_0", title: "Error along the path", unit: "m" }],
    frames: { ...run.frames, series_0: run.frames.error_m, online: null, inliers: null, confidence: null, sigma_m: null, environment: null },
    keyframes: { id: nothing, frame: nothing, place: nothing, thumbnails: [], tracks: null },
    places: { id: nothing, keyframe: nothing, component: nothing, position: column("f32", [], 3) },
    constraints: { from: nothing, to: nothing, source: labels([]) },
    loops: null,
    planes: [],
    floor_plan: [],
    pictures: [],
  };
}

/** The loops of a recognizer on true poses: one is right, one wrong, one missed; scores are no probabilities. */
export function sampleJudged(options: Partial<SampleOptions> = {}): Run {
  const run = sampleEstimate(options);
  const { frames } = run;
  return {
    ...run,
    frames: { ...frames, truth: null, error_m: null, error_deg: null },
    frame_series: [],
    figures: [{ name: "average precision", value: 0.75, unit: "", protocol: "poses within 5 m and 30 deg" }],
    keyframes: sampleRun({ ...options, landmarks: 0 }).keyframes,
    loops: {
      query_frame: column("i32", [540, 550, 560]),
      match_frame: column("i32", [15, 300, 35]),
      probability: null,
      similarity: column("f32", [40, 12, NaN]),
      inliers: null,
      lines: null,
      stage: labels(["right", "wrong", "missed"]),
      reason: labels(["accepted", "geometry", "nothing was proposed"]),
      rank: column("i32", [1, 2, 0]),
      judged: true,
    },
  };
}
