import type { Values } from "../data/column";

/** More landmarks are left out until the next snapshot, which is thinned evenly when it is drawn. */
const MOST = 1000000;

/** Positions of landmarks, in room that grows. */
export class LandmarkList {
  count = 0;
  /** Three values a landmark; valid until the next change. */
  position = new Float32Array(3 * 1024);

  clear(): void {
    this.count = 0;
  }

  add(positions: Values): void {
    const added = Math.min(positions.length / 3, MOST - this.count);
    if (3 * (this.count + added) > this.position.length) {
      const larger = new Float32Array(Math.max(3 * (this.count + added), 2 * this.position.length));
      larger.set(this.position.subarray(0, 3 * this.count));
      this.position = larger;
    }
    this.position.set(positions.subarray(0, 3 * added), 3 * this.count);
    this.count += added;
  }
}
