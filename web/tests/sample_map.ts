import type { Run } from "../src/data/report";
import { column, labels } from "./encode";
import type { Random } from "./random";
import type { SampleOptions } from "./sample";
import { type Drive, STEP } from "./sample_drive";
import { thumbnail } from "./thumbnail";

export interface SampleKeyframes {
  count: number;
  /** Frame of each keyframe. */
  frames: number[];
  /** Keyframe to which each frame is relative, or -1. */
  ofFrame: number[];
  table: Run["keyframes"];
}

const PLACE_KEYFRAMES = 6;

export function sampleKeyframes(o: SampleOptions, path: Drive): SampleKeyframes {
  const frames: number[] = [];
  for (let at = 0; at < o.frames; at += o.keyframeEvery) {
    const frame = Math.floor(at);
    if (path.component[frame] >= 0) frames.push(frame);
  }
  const ofFrame = new Array<number>(o.frames).fill(-1);
  frames.forEach((frame, id) => (ofFrame[frame] = id));
  for (let i = 1; i < o.frames; i++) if (ofFrame[i] < 0 && path.component[i] >= 0) ofFrame[i] = ofFrame[i - 1];
  return {
    count: frames.length,
    frames,
    ofFrame,
    table: {
      id: column(
        "i32",
        frames.map((_, id) => id),
      ),
      frame: column("i32", frames),
      place: column(
        "i32",
        frames.map((_, id) => Math.floor(id / PLACE_KEYFRAMES)),
      ),
      thumbnails: frames.map((frame) => (o.thumbnails ? thumbnail(path.truth[frame].heading, frame * STEP) : "")),
      tracks: sampleTracks(frames.length),
    },
  };
}

/** Ten landmarks a keyframe, each of which three keyframes see while it moves outwards. */
function sampleTracks(keyframes: number): Run["keyframes"]["tracks"] {
  const landmark: number[] = [];
  const pixel: number[] = [];
  for (let k = 0; k < keyframes; k++)
    for (let i = 0; i < 10; i++) {
      const age = (k + i) % 3;
      landmark.push(10 * (k - age) + i);
      pixel.push(20 + 22 * i, 128 + (i % 2 === 0 ? 1 : -1) * (20 + 15 * age));
    }
  return {
    count: column("i32", new Array<number>(keyframes).fill(10)),
    landmark: column("i32", landmark),
    pixel: column("u8", pixel, 2),
  };
}

/** Points of walls on both sides of the path, on the ground, and a few far ones. */
export function sampleLandmarks(
  o: SampleOptions,
  path: Drive,
  taken: SampleKeyframes,
  random: Random,
): Run["landmarks"] {
  const position: number[] = [];
  const colour: number[] = [];
  const sigma: number[] = [];
  const frames: number[] = [];
  const lastKeyframe: number[] = [];
  taken.ofFrame.forEach((id, frame) => lastKeyframe.push(id >= 0 ? id : (lastKeyframe[frame - 1] ?? 0)));
  for (let k = 0; k < o.landmarks; k++) {
    const frame = Math.floor(random.uniform() * Math.min(o.frames, path.lap));
    const pose = path.truth[frame];
    const side = random.uniform() < 0.5 ? -1 : 1;
    const ground = random.uniform() < 0.3;
    const across = ground ? random.between(-4, 4) : side * (5 + random.normal(0.1));
    const height = ground ? 1.5 + random.normal(0.03) : random.between(-4.5, 1.5);
    position.push(pose.x + across * Math.cos(pose.heading), height, pose.z - across * Math.sin(pose.heading));
    const tone = ground ? 90 : 130 + 60 * Math.sin(frame / 11);
    colour.push(
      clamp(tone + random.normal(14)),
      clamp(tone * 0.9 + random.normal(10)),
      clamp(tone * (ground ? 1 : 0.7)),
    );
    sigma.push(0.02 + 0.02 * Math.abs(random.normal()));
    frames.push(lastKeyframe[frame]);
  }
  return {
    position: column("f32", position, 3),
    colour: column("u8", colour, 3),
    sigma_m: column("f32", sigma),
    keyframe: column("i32", frames),
  };
}

function clamp(value: number): number {
  return Math.min(255, Math.max(0, Math.round(value)));
}

export function samplePlaces(
  path: Drive,
  keyframes: SampleKeyframes,
): {
  count: number;
  table: Run["places"];
  constraints: Run["constraints"];
} {
  const anchors = keyframes.frames.map((_, id) => id).filter((id) => id % PLACE_KEYFRAMES === 0);
  const frames = anchors.map((id) => keyframes.frames[id]);
  const from: number[] = [];
  const to: number[] = [];
  const source: string[] = [];
  for (let i = 0; i + 1 < anchors.length; i++) {
    if (path.component[frames[i]] !== path.component[frames[i + 1]]) continue;
    from.push(i);
    to.push(i + 1);
    source.push("odometry");
  }
  return {
    count: anchors.length,
    table: {
      id: column(
        "i32",
        anchors.map((_, i) => i),
      ),
      keyframe: column("i32", anchors),
      component: column(
        "i32",
        frames.map((frame) => path.component[frame]),
      ),
      position: column(
        "f32",
        frames.flatMap((f) => [path.estimate[f].x, path.estimate[f].y, path.estimate[f].z]),
        3,
      ),
    },
    constraints: { from: column("i32", from), to: column("i32", to), source: labels(source) },
  };
}

const REFUSALS = ["retrieval", "reach", "geometry", "drift", "covariance", "support"];

export function sampleLoops(o: SampleOptions, path: Drive, random: Random): { stages: string[]; table: Run["loops"] } {
  const rows: { query: number; match: number; stage: string; probability: number; inliers: number; lines: number }[] =
    [];
  for (let query = Math.ceil(path.lap) + 20; o.loops && query < o.frames; query += 15) {
    const accepted = random.uniform() < 0.45;
    const match = Math.round(query - path.lap) + (accepted ? 0 : Math.round(random.between(-40, 20)));
    if (match < 0 || path.component[query] < 0 || path.component[match] < 0) continue;
    const stage = accepted ? "accepted" : REFUSALS[Math.floor(random.uniform() * REFUSALS.length)];
    rows.push({
      query,
      match,
      stage,
      probability: accepted ? random.between(0.85, 1) : random.between(0, 0.7),
      inliers: accepted ? Math.round(random.between(40, 160)) : Math.round(random.between(0, 25)),
      lines: Math.round(random.between(0, 12)),
    });
  }
  return {
    stages: rows.map((row) => row.stage),
    table: {
      query_frame: column(
        "i32",
        rows.map((row) => row.query),
      ),
      match_frame: column(
        "i32",
        rows.map((row) => row.match),
      ),
      probability: column(
        "f32",
        rows.map((row) => row.probability),
      ),
      similarity: column(
        "f32",
        rows.map((row) => 0.2 + 0.6 * row.probability),
      ),
      inliers: column(
        "i32",
        rows.map((row) => row.inliers),
      ),
      lines: column(
        "i32",
        rows.map((row) => row.lines),
      ),
      stage: labels(
        rows.map((row) => row.stage),
        [...REFUSALS, "accepted"],
      ),
      reason: null,
      rank: null,
      judged: false,
    },
  };
}

export function samplePlanes(path: Drive): Run["planes"] {
  const { halfWidth: w, halfDepth: d } = path;
  const floor = [-w - 6, 1.5, -6, w + 6, 1.5, -6, w + 6, 1.5, 2 * d + 6, -w - 6, 1.5, 2 * d + 6];
  const wall = [-w * 0.6, 1.5, -5.4, w * 0.6, 1.5, -5.4, w * 0.6, -4, -5.4, -w * 0.6, -4, -5.4];
  return [
    { name: "ground", rgb: [110, 120, 130], outline: column("f32", floor, 3), holes: [] },
    { name: "wall 1", rgb: [200, 150, 90], outline: column("f32", wall, 3), holes: [] },
  ];
}
