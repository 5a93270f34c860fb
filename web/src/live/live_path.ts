import { Group } from "three";
import type { Rgb } from "../data/colour_scale";
import { SegmentList, dispose, wideLines } from "../scene/lines";

/** Frames a part: only the parts that change are built again. */
const PART = 256;

/** The trajectory of a run that goes on, in parts. */
export class LivePath {
  readonly object = new Group();
  private readonly parts: Group[] = [];

  constructor(private readonly colour: Rgb) {}

  /** Draws the segments between neighbouring frames from row `from` on; `joined` tells whether rows r and r + 1 are one line. */
  update(positions: Float32Array, count: number, from: number, joined: (row: number) => boolean): void {
    const first = Math.floor(Math.max(from - 1, 0) / PART);
    for (const part of this.parts.splice(first)) dispose(part);
    for (let begin = first * PART; begin < count; begin += PART) {
      const list = new SegmentList();
      for (let row = begin; row < Math.min(begin + PART, count - 1); row++) {
        if (joined(row)) list.add(positions, 3 * row, positions, 3 * row + 3, this.colour);
      }
      const part = new Group();
      part.add(wideLines(list, 3.5, 5));
      this.parts.push(part);
      this.object.add(part);
    }
  }
}
