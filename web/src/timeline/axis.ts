/** The horizontal axis that the graph, the bands and the thumbnails share. */
import type { RunData } from "../data/model";
import { times } from "../data/series";

/** Pixels left and right of the axis: room for the values of the graph. */
export const LEFT = 62;
export const RIGHT = 22;

export class Axis {
  /** Ascending values, one a frame. */
  readonly values: Float64Array;
  readonly full: [number, number];

  constructor(
    run: RunData,
    readonly kind: "frame" | "time",
  ) {
    this.values = kind === "time" ? times(run) : Float64Array.from(run.frames.id);
    const last = this.values.length - 1;
    this.full = last > 0 && this.values[last] > this.values[0] ? [this.values[0], this.values[last]] : [0, 1];
  }

  /** Pixel of a value in a strip of `width` pixels without margins. */
  pixel(value: number, [low, high]: [number, number], width: number): number {
    return ((value - low) / (high - low)) * width;
  }

  value(pixel: number, [low, high]: [number, number], width: number): number {
    return low + (pixel / Math.max(width, 1)) * (high - low);
  }

  /** Row of the frame nearest to a value. */
  row(value: number): number {
    let low = 0;
    let high = this.values.length - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.values[middle] < value) low = middle + 1;
      else high = middle;
    }
    const before = Math.max(low - 1, 0);
    return value - this.values[before] < this.values[low] - value ? before : low;
  }

  /** A range with `factor` times the length about `centre`, within the axis; null for all of it. */
  zoomed(range: [number, number], centre: number, factor: number): [number, number] | null {
    const [low, high] = this.full;
    const least = (high - low) * Math.min(1, 12 / Math.max(this.values.length, 1));
    const length = Math.max((range[1] - range[0]) * factor, least);
    if (length >= high - low) return null;
    const share = (centre - range[0]) / (range[1] - range[0]);
    const start = Math.min(Math.max(centre - share * length, low), high - length);
    return [start, start + length];
  }

  /** `range` moved so that `value` is inside. */
  containing(range: [number, number], value: number): [number, number] {
    if (value >= range[0] && value <= range[1]) return range;
    const length = range[1] - range[0];
    const start = Math.min(Math.max(value - length / 10, this.full[0]), this.full[1] - length);
    return [start, start + length];
  }
}
