import { mainComponent } from "../data/compare";
import { STAGES, VERDICTS, certainty, stageCounts } from "../data/loops";
import type { ReportData, RunData } from "../data/model";
import { availableSeries } from "../data/series";
import type { ColourBy, State, Theme } from "./state";

export function startState(report: ReportData, theme: Theme): State {
  const run = report.runs[0];
  return {
    run: 0,
    row: run ? firstPosed(run) : 0,
    loop: -1,
    landmark: -1,
    observed: null,
    component: run ? startComponent(run) : null,
    colourBy: run ? startColour(run) : "time",
    layers: {
      trajectory: true,
      truth: true,
      online: false,
      before: true,
      frusta: true,
      images: true,
      landmarks: true,
      places: false,
      constraints: false,
      loops: true,
      refused: report.runs.some((r) => r.loops.judged),
      planes: true,
      street: true,
      others: true,
      grid: true,
    },
    pointColour: run ? startPointColour(run) : "height",
    pointSize: 2,
    frustumSize: 1,
    loopFilter: {
      stages: new Set([...STAGES, ...VERDICTS, ...report.runs.flatMap((r) => stageCounts(r.loops).map(([s]) => s))]),
      // Of a recognizer with probabilities, those that it takes for loops.
      minProbability: run?.loops.judged && run.loops.probability !== null ? 0.5 : 0,
    },
    loopOrder: { column: run ? certainty(run.loops) : "probability", descending: true },
    playing: false,
    rate: 4,
    follow: "off",
    series: run ? availableSeries(run)[0] : "inliers",
    axis: "frame",
    range: null,
    tab: run ? (run.loops.judged ? "loops" : "overview") : report.graphs.length > 0 ? "graph" : "pictures",
    compareWith: 1,
    alignOn: run && run.aligned !== null ? "truth" : "beginning",
    threshold: null,
    graph: 0,
    graphShape: report.graphs[0]?.after ? "after" : "before",
    edgeKind: null,
    edge: -1,
    theme,
  };
}

/** Components have coordinate frames of their own: only one is shown at first. */
export function startComponent(run: RunData): number | null {
  return run.components.length > 1 ? mainComponent(run) : null;
}

export function startPointColour(run: RunData): State["pointColour"] {
  return run.landmarks.colour ? "own" : "height";
}

function startColour(run: RunData): ColourBy {
  const available = availableSeries(run);
  return available.includes("error") ? "error" : available.includes("speed") && !run.loops.judged ? "speed" : "time";
}

function firstPosed(run: RunData): number {
  for (let row = 0; row < run.frames.count; row++) if (run.frames.component[row] >= 0) return row;
  return 0;
}

/** What changes when another run is chosen; the cursor stays at the same frame id. */
export function chooseRun(report: ReportData, state: State, index: number): Partial<State> {
  const run = report.runs[index];
  const id = report.runs[state.run].frames.id[state.row];
  const series = availableSeries(run);
  return {
    run: index,
    row: run.frames.rowOf.get(id) ?? firstPosed(run),
    loop: -1,
    landmark: -1,
    observed: null,
    range: null,
    playing: false,
    component: startComponent(run),
    pointColour: startPointColour(run),
    series: series.includes(state.series) ? state.series : series[0],
    colourBy: colourFor(run, state.colourBy),
    compareWith: state.compareWith === index ? state.run : state.compareWith,
  };
}

function colourFor(run: RunData, wanted: ColourBy): ColourBy {
  if (wanted === "component" || wanted === "run") return wanted;
  return availableSeries(run).includes(wanted) ? wanted : "speed";
}
