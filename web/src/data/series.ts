/** Values along a run, one a frame: what graphs and colours show. */
import type { RunData } from "./model";

type KnownSeries = "error" | "rotation_error" | "speed" | "uncertainty" | "confidence" | "inliers" | "time";
/** `more:N` is the N-th of the series that the report names itself. */
export type SeriesName = KnownSeries | `more:${number}`;

export interface Series {
  name: SeriesName;
  title: string;
  unit: string;
  values: Float64Array;
}

export function lengthUnit(run: RunData): string {
  return run.metric ? "m" : "map units";
}

export function availableSeries(run: RunData): SeriesName[] {
  const { frames } = run;
  const names: SeriesName[] = [];
  if (hasValues(frames.errorM)) names.push("error");
  if (hasValues(frames.errorDeg)) names.push("rotation_error");
  frames.more.forEach((each, i) => {
    if (hasValues(each.values)) names.push(`more:${i}`);
  });
  if (frames.inliers !== null) names.push("inliers");
  if (hasValues(frames.confidence)) names.push("confidence");
  if (hasValues(frames.sigma)) names.push("uncertainty");
  if (hasValues(frames.pose)) names.push("speed");
  names.push("time");
  return names;
}

function isNamed(name: SeriesName): name is `more:${number}` {
  return name.startsWith("more:");
}

function hasValues(values: ArrayLike<number> | null): boolean {
  if (values === null) return false;
  for (let i = 0; i < values.length; i++) if (Number.isFinite(values[i])) return true;
  return false;
}

export function series(run: RunData, name: SeriesName): Series {
  const { frames } = run;
  const unit = lengthUnit(run);
  if (isNamed(name)) {
    const more = frames.more[Number(name.slice(5))];
    if (!more) return { name, title: "Unknown", unit: "", values: copyOf(null, frames.count) };
    return { name, title: more.title, unit: more.unit, values: Float64Array.from(more.values) };
  }
  switch (name) {
    case "error":
      return { name, title: "Position error", unit: "m", values: copyOf(frames.errorM, frames.count) };
    case "rotation_error":
      return { name, title: "Rotation error", unit: "deg", values: copyOf(frames.errorDeg, frames.count) };
    case "uncertainty":
      return { name, title: "Position uncertainty (1 sigma)", unit, values: copyOf(frames.sigma, frames.count) };
    case "confidence":
      return { name, title: "Confidence", unit: "", values: copyOf(frames.confidence, frames.count) };
    case "inliers":
      return { name, title: "Inliers", unit: "", values: copyOf(frames.inliers, frames.count) };
    case "speed":
      return { name, title: "Speed", unit: `${unit}/s`, values: speeds(run) };
    case "time":
      return { name, title: "Time", unit: "s", values: times(run) };
  }
}

function copyOf(values: ArrayLike<number> | null, count: number): Float64Array {
  return values === null ? new Float64Array(count).fill(NaN) : Float64Array.from(values);
}

/** Seconds since the first frame. */
export function times(run: RunData): Float64Array {
  const { stamp, count } = run.frames;
  const result = new Float64Array(count);
  for (let i = 0; i < count; i++) result[i] = stamp[i] - stamp[0];
  return result;
}

/** Whether frames `a` and `b` have poses in one component. */
export function joined(run: RunData, a: number, b: number): boolean {
  const { component, pose } = run.frames;
  return component[a] === component[b] && Number.isFinite(pose[7 * a]) && Number.isFinite(pose[7 * b]);
}

/** Speed over a window of five frames, so that jitter does not hide the motion. */
export function speeds(run: RunData, half = 2): Float64Array {
  const { pose, stamp, count } = run.frames;
  const result = new Float64Array(count).fill(NaN);
  for (let i = 0; i < count; i++) {
    if (!Number.isFinite(pose[7 * i])) continue;
    let a = i;
    let b = i;
    while (a > 0 && i - a < half && joined(run, a - 1, i)) a--;
    while (b + 1 < count && b - i < half && joined(run, b + 1, i)) b++;
    const seconds = stamp[b] - stamp[a];
    if (b > a && seconds > 0) result[i] = pathLength(pose, a, b) / seconds;
  }
  return result;
}

function pathLength(pose: ArrayLike<number>, from: number, to: number): number {
  let sum = 0;
  for (let i = 7 * from; i < 7 * to; i += 7) {
    sum += Math.hypot(pose[i + 7] - pose[i], pose[i + 8] - pose[i + 1], pose[i + 9] - pose[i + 2]);
  }
  return sum;
}

/** Path length over all frames with a pose, also those that the page has not, without the jumps between components. */
export function travelled(run: RunData): number {
  if (run.summary.path_length !== null) return run.summary.path_length;
  let sum = 0;
  for (let i = 0; i + 1 < run.frames.count; i++) {
    if (joined(run, i, i + 1)) sum += pathLength(run.frames.pose, i, i + 1);
  }
  return sum;
}
