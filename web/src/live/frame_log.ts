import { type FrameColumns, type FrameEvent, type FrameState, FRAME_STATES } from "./events";

/** Columns with room for `capacity` frames: 43 bytes a frame. */
function columns(capacity: number): {
  id: Int32Array;
  component: Int32Array;
  pose: Float32Array;
  inliers: Float32Array;
  state: Int8Array;
  keyframe: Uint8Array;
} {
  return {
    id: new Int32Array(capacity),
    component: new Int32Array(capacity),
    pose: new Float32Array(7 * capacity),
    inliers: new Float32Array(capacity),
    state: new Int8Array(capacity),
    keyframe: new Uint8Array(capacity),
  };
}

/** The frames of a run that goes on, in the order of their ids. */
export class FrameLog {
  count = 0;
  /** Counts how often rows have become those of other frames. */
  shifts = 0;
  private changed = Infinity;
  private data = columns(256);
  private readonly rows = new Map<number, number>();

  row(id: number): number {
    return this.rows.get(id) ?? -1;
  }

  id(row: number): number {
    return this.data.id[row];
  }

  component(row: number): number {
    return this.data.component[row];
  }

  /** Seven values a row; valid until the next change. */
  get pose(): Float32Array {
    return this.data.pose;
  }

  inliers(row: number): number {
    return this.data.inliers[row];
  }

  state(row: number): FrameState | null {
    return FRAME_STATES[this.data.state[row]] ?? null;
  }

  isKeyframe(row: number): boolean {
    return this.data.keyframe[row] === 1;
  }

  isPosed(row: number): boolean {
    return this.data.component[row] >= 0 && Number.isFinite(this.data.pose[7 * row]);
  }

  clear(): void {
    this.count = 0;
    this.rows.clear();
  }

  /** The first row that a frame was put into since the last call; Infinity without one. */
  takeChanged(): number {
    const first = this.changed;
    this.changed = Infinity;
    return first;
  }

  /** Adds a frame, or replaces what is known of it; returns its row. */
  put(frame: FrameEvent): number {
    const known = this.row(frame.frame);
    const row = known >= 0 ? known : this.insert(frame.frame);
    this.changed = Math.min(this.changed, row);
    this.data.component[row] = frame.pose === null ? -1 : frame.component;
    for (let k = 0; k < 7; k++) this.data.pose[7 * row + k] = frame.pose?.[k] ?? NaN;
    this.data.inliers[row] = frame.inliers;
    this.data.state[row] = FRAME_STATES.indexOf(frame.state);
    this.data.keyframe[row] = frame.keyframe ? 1 : 0;
    return row;
  }

  /** Has these frames from now on, and no others. */
  load({ count, ...frames }: FrameColumns): void {
    const both = Math.min(this.count, count);
    if (this.data.id.subarray(0, both).some((id, row) => id !== frames.id[row])) this.shifts++;
    while (this.data.id.length < count) this.grow();
    for (const name of Object.keys(frames) as (keyof typeof frames)[]) this.data[name].set(frames[name]);
    this.count = count;
    this.rows.clear();
    for (let row = 0; row < count; row++) this.rows.set(frames.id[row], row);
  }

  /** A new row for an id, with nothing known of it. Ids come in ascending order, but for joins in the middle of a run. */
  private insert(id: number): number {
    if (this.count === this.data.id.length) this.grow();
    let row = this.count;
    while (row > 0 && this.data.id[row - 1] > id) row--;
    if (row < this.count) this.shift(row);
    this.count++;
    this.data.id[row] = id;
    this.rows.set(id, row);
    this.data.component[row] = -1;
    this.data.pose.fill(NaN, 7 * row, 7 * row + 7);
    this.data.inliers[row] = NaN;
    this.data.state[row] = -1;
    this.data.keyframe[row] = 0;
    return row;
  }

  private shift(from: number): void {
    this.shifts++;
    const { pose, ...single } = this.data;
    for (const column of Object.values(single)) column.copyWithin(from + 1, from, this.count);
    pose.copyWithin(7 * (from + 1), 7 * from, 7 * this.count);
    for (let row = from + 1; row <= this.count; row++) this.rows.set(this.data.id[row], row);
  }

  private grow(): void {
    const larger = columns(2 * this.data.id.length);
    for (const name of Object.keys(larger) as (keyof typeof larger)[]) larger[name].set(this.data[name]);
    this.data = larger;
  }
}
