/** After an edit the page shows the same run with other data. */
import { stageCounts } from "../data/loops";
import type { ReportData, RunData } from "../data/model";
import { clampRow } from "../page/actions";
import type { State, Store } from "../page/state";

/** Puts the content of `next` into `report`; the choices of the user stay, by frame ids. `loop` is selected if there is one. */
export function replaceReport(
  report: ReportData,
  store: Store,
  next: ReportData,
  loop: { query: number; match: number } | null,
): void {
  const before = report.runs[store.state.run];
  next.runs.forEach((run, i) => rememberPoses(report.runs[i], run));
  Object.assign(report, next);
  const run = report.runs[store.state.run];
  if (before && run) store.refresh(keptState(before, run, store.state, loop));
}

/** The poses before the edit, if the edit has moved any. */
function rememberPoses(before: RunData | undefined, run: RunData): void {
  if (!before || before.frames.count !== run.frames.count) return;
  const moved = before.frames.pose.some((value, i) => Math.abs(value - run.frames.pose[i]) > 1e-6);
  if (moved) run.before = before.frames.pose;
}

function keptState(
  before: RunData,
  run: RunData,
  state: Readonly<State>,
  loop: { query: number; match: number } | null,
): Partial<State> {
  const selected =
    loop ?? (state.loop >= 0 ? { query: before.loops.query[state.loop], match: before.loops.match[state.loop] } : null);
  const stages = new Set(state.loopFilter.stages);
  const known = new Set(stageCounts(before.loops).map(([stage]) => stage));
  for (const [stage] of stageCounts(run.loops)) if (!known.has(stage)) stages.add(stage);
  return {
    row: run.frames.rowOf.get(before.frames.id[state.row]) ?? clampRow(run, state.row),
    loop: selected === null ? -1 : findLoop(run, selected.query, selected.match),
    component: run.components.some(({ number }) => number === state.component) ? state.component : null,
    loopFilter: { ...state.loopFilter, stages },
    landmark: -1,
    observed: null,
  };
}

/** Row of the loop between two frames, or -1. */
export function findLoop({ loops }: RunData, a: number, b: number): number {
  for (let row = 0; row < loops.count; row++) {
    const [query, match] = [loops.query[row], loops.match[row]];
    if ((query === a && match === b) || (query === b && match === a)) return row;
  }
  return -1;
}
