/** Changes of the state that several views ask for. */
import { filterLoops, sortLoops } from "../data/loops";
import type { ReportData, RunData } from "../data/model";
import { keyframeOf } from "../data/run_view";
import type { Follow, State, Store } from "./state";

/** Selects a loop; the cursor goes to its query frame, the scene to the component of that frame. */
export function loopSelection(report: ReportData, state: Readonly<State>, loop: number): Partial<State> {
  const run = report.runs[state.run];
  const row = run.frames.rowOf.get(run.loops.query[loop]);
  const change: Partial<State> = { loop, playing: false };
  if (row === undefined) return change;
  change.row = row;
  const component = run.frames.component[row];
  if (state.component !== null && component >= 0 && component !== state.component) change.component = component;
  return change;
}

/** Selects the next or previous loop, by query frame, of those that pass the filter. */
export function moveToLoop(report: ReportData, store: Store, direction: 1 | -1): void {
  const { state } = store;
  const run = report.runs[state.run];
  if (!run) return;
  const order = { column: "query" as const, descending: false };
  const loops = sortLoops(run.loops, filterLoops(run.loops, state.loopFilter), order);
  const selected = loops.indexOf(state.loop);
  const id = run.frames.id[state.row];
  const after = loops.findIndex((loop) => run.loops.query[loop] > id);
  const here = after < 0 ? loops.length : after;
  const next = selected >= 0 ? selected + direction : direction > 0 ? here : here - 1;
  if (loops[next] !== undefined) store.set({ ...loopSelection(report, state, loops[next]), tab: "loops" });
}

export function clampRow(run: RunData, row: number): number {
  return Math.min(Math.max(row, 0), Math.max(run.frames.count - 1, 0));
}

export function moveCursor(report: ReportData, store: Store, by: number): void {
  const run = report.runs[store.state.run];
  if (run) store.set({ row: clampRow(run, store.state.row + by), playing: false });
}

export function toggleFollow(store: Store, follow: Follow): void {
  store.set({ follow: store.state.follow === follow ? "off" : follow });
}

/** Moves the cursor to the next or previous keyframe. */
export function moveToKeyframe(report: ReportData, store: Store, direction: 1 | -1): void {
  const run = report.runs[store.state.run];
  if (!run) return;
  for (let row = store.state.row + direction; row >= 0 && row < run.frames.count; row += direction) {
    if (keyframeOf(run, row) >= 0) {
      store.set({ row, playing: false });
      return;
    }
  }
}

/** Plays the frames in the time of their stamps, `rate` times as fast. */
export function watchPlaying(report: ReportData, store: Store): void {
  let last = 0;
  let time = 0;
  let shown = -1;
  const step = (now: number): void => {
    const { playing, rate, row, run } = store.state;
    if (!playing) return;
    const { stamp, count } = report.runs[run].frames;
    if (row !== shown) time = stamp[row]; // the user has moved the cursor
    time += (rate * Math.min(now - last, 200)) / 1000;
    last = now;
    let next = row;
    while (next + 1 < count && stamp[next + 1] <= time) next++;
    shown = next;
    if (next !== row) store.set({ row: next });
    if (next + 1 >= count) store.set({ playing: false });
    else requestAnimationFrame(step);
  };
  store.on(["playing", "run"], ({ playing, row, run }) => {
    if (!playing) return;
    const frames = report.runs[run].frames;
    if (row + 1 >= frames.count) store.set({ row: 0 });
    last = performance.now();
    shown = store.state.row;
    time = frames.stamp[shown];
    requestAnimationFrame(step);
  });
}
