/** Synthetic reports: a camera drives around a block; a seed determines every value. */
import type { Graph, Picture, Report, Run } from "../src/data/report";
import { column, labels } from "./encode";
import { Random } from "./random";
import { sampleGraph } from "./sample_graph";
import { type Drive, drive, posesOf } from "./sample_drive";
import { sampleEarth, sampleStreet } from "./sample_earth";
import { sampleKeyframes, sampleLandmarks, sampleLoops, samplePlaces, samplePlanes } from "./sample_map";

export interface SampleOptions {
  seed: number;
  name: string;
  frames: number;
  keyframeEvery: number;
  landmarks: number;
  /** Spans of frame ids, both ends included, without a pose. */
  lost: [number, number][];
  /** With 2, the frames after the first lost span are a second component. */
  components: 1 | 2;
  loops: boolean;
  truth: boolean;
  metric: boolean;
  thumbnails: boolean;
  /** A street map and a track on the earth. */
  street: boolean;
  earth: boolean;
  /** From this frame on the estimate bends away from the path, by 4 cm a frame. */
  partsAt: number | null;
}

export const DEFAULTS: SampleOptions = {
  seed: 1,
  name: "block",
  frames: 1101,
  keyframeEvery: 3.4,
  landmarks: 20000,
  lost: [],
  components: 1,
  loops: true,
  truth: true,
  metric: true,
  thumbnails: true,
  street: false,
  earth: false,
  partsAt: null,
};

export function sampleRun(options: Partial<SampleOptions> = {}): Run {
  const o: SampleOptions = { ...DEFAULTS, ...options };
  const random = new Random(o.seed);
  const path = drive(o, random);
  const keyframes = sampleKeyframes(o, path);
  const landmarks = sampleLandmarks(o, path, keyframes, random);
  const places = samplePlaces(path, keyframes);
  const loops = sampleLoops(o, path, random);
  const accepted = loops.stages.filter((stage) => stage === "accepted").length;
  const posed = path.component.filter((component) => component >= 0).length;
  return {
    name: o.name,
    folder: `/data/runs/${o.name}`,
    recording: "block",
    sensor: "stereo",
    metric: o.metric,
    aligned: null,
    up: null,
    summary: {
      frames: o.frames,
      posed,
      keyframes: keyframes.count,
      places: places.count,
      landmarks: o.landmarks,
      loops_accepted: accepted,
      cpu_s: 0.061 * o.frames,
      wall_s: 0.034 * o.frames,
      path_length: null,
    },
    judgement: {
      verdict: posed < o.frames ? "doubtful" : "good",
      metric: o.metric,
      why_metric: o.metric ? "by the baseline of 0.54 m" : "one camera alone does not observe the scale",
      expected_drift_m: 0.42,
      findings:
        posed < o.frames
          ? [
              {
                cause: "blur",
                text: `${o.frames - posed} frames are lost: the images are blurred.`,
                advice: "Use a shorter exposure, or move more slowly in dark rooms.",
              },
            ]
          : [],
    },
    notes: ["The last loop closed 3 s before the end of the sequence."],
    options: [{ name: "loops.min_similarity", value: "0.30", default_value: "0.25" }],
    figures: o.truth ? figuresOf(path) : [],
    tables: [],
    camera: { width: 960, height: 540, fx: 520, fy: 520, cx: 480, cy: 270 },
    components: componentsOf(path),
    frames: framesOf(o, path, keyframes.ofFrame),
    keyframes: keyframes.table,
    landmarks,
    places: places.table,
    constraints: places.constraints,
    loops: loops.table,
    planes: samplePlanes(path),
    floor_plan: floorPlan(path),
    street_map: o.street ? sampleStreet(path) : null,
    georeference: o.earth ? sampleEarth(path) : null,
    pictures: [picture("Trajectory from above", path)],
    frame_series: [],
  };
}

export function sampleReport(runs: Run[], graphs: Graph[] = []): Report {
  return {
    format: "placegraph-report-1",
    program: "placegraph 0.2.0",
    title: runs.map((run) => run.name).join(", ") || "pose graph",
    runs,
    pictures: [],
    tables: [],
    graphs,
  };
}

export { sampleGraph };

function figuresOf(path: Drive): Run["figures"] {
  const errors = path.error.filter((error) => Number.isFinite(error));
  const ate = Math.sqrt(errors.reduce((sum, error) => sum + error * error, 0) / errors.length);
  return [
    { name: "ATE", value: ate, unit: "m", protocol: "se3 alignment, all posed frames, RMSE" },
    { name: "RPE", value: 0.021, unit: "m", protocol: "pairs one second apart, RMSE" },
    {
      name: "Frames posed",
      value: (100 * errors.length) / path.error.length,
      unit: "%",
      protocol: "share of all input frames",
    },
  ];
}

function componentsOf(path: Drive): Run["components"] {
  return [...new Set(path.component.filter((number) => number >= 0))].map((number, i) => ({
    number,
    main: i === 0,
    first: path.component.indexOf(number),
    last: path.component.lastIndexOf(number),
    posed: path.component.filter((other) => other === number).length,
  }));
}

function framesOf(o: SampleOptions, path: Drive, keyframe: number[]): Run["frames"] {
  const n = o.frames;
  const rows = Array.from({ length: n }, (_, i) => i);
  const lost = (i: number): boolean => path.component[i] < 0;
  return {
    id: column("i32", rows),
    stamp_s: column(
      "f64",
      rows.map((i) => 1.6e9 + i * 0.1),
    ),
    component: column("i32", path.component),
    keyframe: column("i32", keyframe),
    pose: column("f32", posesOf(path.estimate), 7),
    online: column("f32", posesOf(path.online), 7),
    truth: o.truth ? column("f32", posesOf(path.truth), 7) : null,
    error_m: o.truth ? column("f32", path.error) : null,
    error_deg: o.truth
      ? column(
          "f32",
          path.error.map((e) => e * 2),
        )
      : null,
    sigma_m: column(
      "f32",
      rows.map((i) => (lost(i) ? NaN : 0.02 + 0.08 * Math.abs(Math.sin((4 * Math.PI * i) / n)))),
    ),
    confidence: column(
      "f32",
      rows.map((i) => (lost(i) ? NaN : 0.8 + 0.19 * Math.cos(i / 40))),
    ),
    inliers: column(
      "i32",
      rows.map((i) => (lost(i) ? 0 : Math.round(140 + 70 * Math.sin(i / 25) + 20 * Math.sin(i * 1.7)))),
    ),
    reason: labels(rows.map((i) => (lost(i) ? "too few points agree with the motion" : null))),
    environment: labels(rows.map((i) => (Math.floor((6 * i) / n) % 2 === 0 ? "street" : "yard"))),
  };
}

function floorPlan(path: Drive): Run["floor_plan"] {
  const { halfWidth: w, halfDepth: d } = path;
  const box = (scale: number): number[] => [
    -w * scale,
    0,
    w * scale,
    0,
    w * scale,
    2 * d * scale,
    -w * scale,
    2 * d * scale,
  ];
  return [
    { label: "outer wall", closed: true, points: column("f32", box(1.2), 2) },
    { label: "block", closed: true, points: column("f32", box(0.8), 2) },
  ];
}

function picture(title: string, path: Drive): Picture {
  const step = Math.max(1, Math.floor(path.truth.length / 300));
  const points = path.truth
    .filter((_, i) => i % step === 0)
    .map((pose) => `${pose.x.toFixed(2)},${(-pose.z).toFixed(2)}`);
  const { halfWidth: w, halfDepth: d } = path;
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="${-w - 3} ${-2 * d - 3} ${2 * w + 6} ${2 * d + 6}" width="640" height="480">
<style>path { stroke-linejoin: round; }</style><rect x="-500" y="-500" width="1000" height="1000" fill="#ffffff"/>
<path d="M${points.join("L")}" fill="none" stroke="#0072b2" stroke-width="0.3"/></svg>`;
  return { title, caption: "The true path; the first frame is at the bottom.", svg };
}
