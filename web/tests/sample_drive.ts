import type { SampleOptions } from "./sample";
import type { Random } from "./random";

/** A pose in the map: x right, y down, z forward at the first frame; `heading` about y. */
export interface Pose {
  x: number;
  y: number;
  z: number;
  heading: number;
}

export interface Drive {
  truth: Pose[];
  /** NaN where the frame is lost. */
  estimate: Pose[];
  online: Pose[];
  error: number[];
  component: number[];
  /** Frames in one lap around the block. */
  lap: number;
  halfWidth: number;
  halfDepth: number;
}

export const STEP = 0.25;
const LOST: Pose = { x: NaN, y: NaN, z: NaN, heading: NaN };

/** Two laps and a bit around a block, so that the second lap closes loops with the first. */
export function drive(o: SampleOptions, random: Random): Drive {
  const lap = o.frames / 2.1;
  const halfWidth = ((lap * STEP) / (2 * Math.PI)) * 1.15;
  const halfDepth = halfWidth * 0.72;
  const truth = Array.from({ length: o.frames }, (_, i) => around(i / lap, halfWidth, halfDepth));
  const lost = (i: number): boolean => o.lost.some(([from, to]) => i >= from && i <= to);
  const split = o.components === 2 && o.lost.length > 0 ? o.lost[0][1] : Infinity;
  const phase = random.between(0, 6);
  const estimate = truth.map((pose, i) => (lost(i) ? LOST : withError(pose, i, lap, phase, o)));
  const online = truth.map((pose, i) => {
    const drift = (1.2 * Math.min(i, lap)) / lap + 0.4 * Math.sin((3 * i) / lap);
    return lost(i)
      ? LOST
      : { x: pose.x + drift, y: pose.y + random.normal(0.01), z: pose.z - 0.6 * drift, heading: pose.heading };
  });
  const error = estimate.map((pose, i) => Math.hypot(pose.x - truth[i].x, pose.y - truth[i].y, pose.z - truth[i].z));
  return {
    truth,
    estimate,
    online,
    error,
    lap,
    halfWidth,
    halfDepth,
    component: truth.map((_, i) => (lost(i) ? -1 : i > split ? 1 : 0)),
  };
}

/** A rounded rectangle: a superellipse of power 4, begun at its lower side, driven to the right. */
function around(laps: number, halfWidth: number, halfDepth: number): Pose {
  const at = (share: number): { x: number; z: number } => {
    const angle = 2 * Math.PI * share - Math.PI / 2;
    const power = (v: number): number => Math.sign(v) * Math.sqrt(Math.abs(v));
    return { x: halfWidth * power(Math.cos(angle)), z: halfDepth * (1 + power(Math.sin(angle))) };
  };
  const here = at(laps);
  const before = at(laps - 0.002);
  const after = at(laps + 0.002);
  const lane = Math.floor(laps) * 0.4;
  return {
    x: here.x,
    y: -0.3 * Math.sin(2 * Math.PI * laps),
    z: here.z + lane,
    heading: Math.atan2(after.x - before.x, after.z - before.z),
  };
}

function withError(pose: Pose, i: number, lap: number, phase: number, o: SampleOptions): Pose {
  const size = 0.12 * Math.min(1, i / 60);
  const bend = o.partsAt !== null && i >= o.partsAt ? 0.04 * (i - o.partsAt + 1) : 0;
  return {
    x: pose.x + (o.partsAt === null ? size * Math.sin((9 * i) / lap + phase) : 0) + bend,
    y: pose.y + (o.partsAt === null ? 0.3 * size * Math.sin((17 * i) / lap) : 0),
    z: pose.z + (o.partsAt === null ? size * Math.cos((7 * i) / lap + phase) : 0),
    heading: pose.heading,
  };
}

export function posesOf(poses: Pose[]): number[] {
  return poses.flatMap(({ x, y, z, heading }) => [x, y, z, 0, Math.sin(heading / 2), 0, Math.cos(heading / 2)]);
}
