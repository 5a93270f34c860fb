import { cssColour } from "../data/colour_scale";
import { formatCount, formatNumber, formatPercent, formatTime, plural } from "../data/format";
import {
  type LoopColumn,
  type NumberColumn,
  certainty,
  filterLoops,
  loopValue,
  sortLoops,
  stageCounts,
  stageOf,
  stageSentence,
} from "../data/loops";
import { label, type RunData } from "../data/model";
import { keyframeAt } from "../data/run_view";
import { EditPanel, loopButtons } from "../edit/edit_panel";
import { showFullImage } from "../live/frame_files";
import { loopSelection } from "../page/actions";
import { button, checkbox, el, facts, isPicture, slider } from "../page/dom";
import type { Store } from "../page/state";
import { MATCH, QUERY } from "../scene/cursor_layer";
import { stageColour } from "../scene/loops_layer";
import type { Panel, PanelContext } from "./panel";

const ROWS = 300;
const NUMBERS: NumberColumn[] = ["probability", "similarity", "inliers", "lines", "rank"];

/** The columns of a run's table: those of which anything is known. */
function columnsOf({ loops }: RunData): [LoopColumn, string][] {
  const titles: Record<NumberColumn, string> = {
    probability: "Prob.",
    similarity: loops.judged ? "Score" : "Sim.",
    inliers: "Inliers",
    lines: "Lines",
    rank: "Rank",
  };
  const columns: [LoopColumn, string][] = [
    ["query", "Query"],
    ["match", "Match"],
    ["stage", loops.judged ? "Verdict" : "Stage"],
  ];
  if (loops.reason !== null && loops.reason.table.length > 0) columns.push(["reason", "Stage"]);
  for (const name of NUMBERS) if (loops[name] !== null) columns.push([name, titles[name]]);
  return columns;
}

export function loopsPanel(context: PanelContext): Panel {
  const { report, store } = context;
  const editor = context.served?.editor ?? null;
  const edits = editor ? new EditPanel(editor, report, store) : null;
  // The filters stay in the page while the table changes, so that a slider can be dragged.
  const detail = el("div");
  const choice = el("div");
  const rows = el("div");
  const root = el("div", {}, detail, edits?.element ?? null, choice, rows);
  let filtersOf: RunData | null = null;
  const showSelected = (): void => detail.replaceChildren(selectedLoop(context, report.runs[store.state.run]));
  editor?.on(showSelected);
  return {
    title: "Loops",
    available: editor !== null || report.runs.some((run) => run.loops.count > 0),
    keys: ["run", "loop", "loopOrder", "loopFilter"],
    render: () => {
      const run = report.runs[store.state.run];
      if (run.loops.count === 0) {
        const none = el("p", {}, "This run has no loop candidates.");
        return edits ? el("div", {}, none, edits.element) : none;
      }
      if (edits && edits.element.parentElement !== root) choice.before(edits.element);
      if (filtersOf !== run) choice.replaceChildren(filters(run, store));
      filtersOf = run;
      const focused = rows.contains(document.activeElement) && document.activeElement?.tagName === "TR";
      showSelected();
      rows.replaceChildren(table(context, run));
      if (focused) rows.querySelector<HTMLElement>('tr[aria-current="true"]')?.focus();
      return root;
    },
  };
}

function selectedLoop({ store, served }: PanelContext, run: RunData): HTMLElement {
  const { loop } = store.state;
  if (loop < 0) return el("p", { class: "soft" }, "Select a loop in the table or in the scene.");
  const { loops } = run;
  const stage = stageOf(loops, loop);
  return el(
    "section",
    { class: "loop-detail", "aria-live": "polite" },
    el(
      "div",
      { class: "pair" },
      view(run, loops.query[loop], "Query", QUERY, store, served !== null),
      view(run, loops.match[loop], "Match", MATCH, store, served !== null),
    ),
    el("p", {}, el("strong", {}, stageSentence(stage))),
    served?.editor && !run.loops.judged ? loopButtons(served.editor, run, loop) : null,
    facts(loopFacts(run, loop)),
  );
}

function loopFacts(run: RunData, loop: number): [string, string][] {
  const { loops } = run;
  const rows: [string, string][] = [];
  const reason = loops.reason === null ? null : label(loops.reason, loop);
  if (reason !== null) rows.push([stageOf(loops, loop) === "missed" ? "Why" : "Decided by", reason]);
  if (loops.probability) rows.push(["Probability of the same place", formatPercent(loops.probability[loop])]);
  if (loops.similarity) rows.push([loops.judged ? "Score" : "Similarity", formatNumber(loops.similarity[loop])]);
  if (loops.inliers) rows.push(["Inliers", formatNumber(loops.inliers[loop])]);
  if (loops.lines) rows.push(["Lines", formatNumber(loops.lines[loop])]);
  if (loops.rank) rows.push(["Rank of the first true candidate", loops.rank[loop] > 0 ? String(loops.rank[loop]) : "none"]);
  rows.push(["Time between the two", timeBetween(run, loop)]);
  return rows;
}

function timeBetween(run: RunData, loop: number): string {
  const a = run.frames.rowOf.get(run.loops.query[loop]);
  const b = run.frames.rowOf.get(run.loops.match[loop]);
  return a === undefined || b === undefined
    ? "unknown"
    : formatTime(Math.abs(run.frames.stamp[a] - run.frames.stamp[b]));
}

function view(
  run: RunData,
  frame: number,
  title: string,
  colour: [number, number, number],
  store: Store,
  full: boolean,
): HTMLElement {
  const row = run.frames.rowOf.get(frame);
  const k = row === undefined ? -1 : keyframeAt(run, row);
  const uri = run.keyframes.frame[k] === frame ? run.keyframes.thumbnails[k] : undefined;
  const go = button(`${title}: frame ${frame}`, "Move the cursor to this frame", () => {
    if (row !== undefined) store.set({ row });
  });
  go.style.borderColor = cssColour(colour);
  const image = isPicture(uri)
    ? el("img", { src: uri, alt: `Image of frame ${frame}` })
    : el("p", { class: "soft" }, "No image.");
  if (full && image instanceof HTMLImageElement) showFullImage(image, store.state.run, frame);
  return el("figure", {}, image, el("figcaption", {}, go));
}

function filters(run: RunData, store: Store): HTMLElement {
  const { loopFilter } = store.state;
  const box = el("fieldset", { class: "filters" }, el("legend", {}, run.loops.judged ? "Verdicts" : "Stages"));
  for (const [stage, count] of stageCounts(run.loops)) {
    const check = checkbox(`${stage} (${formatCount(count)})`, loopFilter.stages.has(stage), (on) => {
      const stages = new Set(store.state.loopFilter.stages);
      if (on) stages.add(stage);
      else stages.delete(stage);
      store.set({ loopFilter: { ...store.state.loopFilter, stages } });
    });
    const mark = el("span", { class: "mark" });
    mark.style.background = cssColour(stageColour(stage));
    check.append(mark);
    box.append(check);
  }
  box.append(leastCertainty(run, store));
  return box;
}

/** The slider for the probability, or for the score of a recognizer without probabilities. */
function leastCertainty(run: RunData, store: Store): HTMLElement {
  const { loopFilter } = store.state;
  const probable = certainty(run.loops) === "probability";
  const values = run.loops[certainty(run.loops)] ?? [];
  let most = probable ? 1 : 0;
  for (let i = 0; i < values.length; i++) if (values[i] > most) most = values[i];
  const least = el("output", {}, formatNumber(loopFilter.minProbability));
  const title = probable ? "Probability at least" : "Score at least";
  const box = slider(title, 0, most, most / 20, loopFilter.minProbability, (minProbability) => {
    least.textContent = formatNumber(minProbability);
    store.set({ loopFilter: { ...store.state.loopFilter, minProbability } });
  });
  box.append(least);
  return box;
}

function table({ report, store }: PanelContext, run: RunData): HTMLElement {
  const { loopFilter, loopOrder, loop } = store.state;
  const rows = sortLoops(run.loops, filterLoops(run.loops, loopFilter), loopOrder);
  const head = el("tr");
  const columns = columnsOf(run);
  for (const [column, title] of columns) {
    const active = loopOrder.column === column;
    const sort = button(
      active ? `${title} ${loopOrder.descending ? "▼" : "▲"}` : title,
      `Sort by ${title.toLowerCase()}`,
      () => store.set({ loopOrder: { column, descending: active ? !loopOrder.descending : column === "probability" } }),
    );
    head.append(el("th", { "aria-sort": active ? (loopOrder.descending ? "descending" : "ascending") : "none" }, sort));
  }
  const body = el("tbody");
  for (const row of rows.slice(0, ROWS))
    body.append(tableRow(run, columns, row, row === loop, () => store.set(loopSelection(report, store.state, row))));
  const more =
    rows.length > ROWS
      ? el("p", { class: "soft" }, `The first ${ROWS} are in the table; filter or sort to see others.`)
      : null;
  return el(
    "div",
    {},
    el("p", {}, `${plural(rows.length, "loop candidate")} of ${formatCount(run.loops.count)}`),
    el("div", { class: "wide" }, el("table", { class: "loops" }, el("thead", {}, head), body)),
    more,
  );
}

function cellText({ loops }: RunData, column: LoopColumn, row: number): string {
  switch (column) {
    case "query":
    case "match":
      return String(loops[column][row]);
    case "stage":
      return stageOf(loops, row);
    case "reason":
      return (loops.reason && label(loops.reason, row)) ?? "";
    case "rank":
      return (loops.rank?.[row] ?? 0) > 0 ? String(loops.rank?.[row]) : "–";
    default:
      return formatNumber(loopValue(loops, column, row), column === "inliers" || column === "lines" ? undefined : 2);
  }
}

function tableRow(
  run: RunData,
  columns: [LoopColumn, string][],
  row: number,
  selected: boolean,
  choose: () => void,
): HTMLElement {
  const stage = stageOf(run.loops, row);
  const element = el("tr", {
    tabindex: "0",
    "aria-current": String(selected),
    "data-loop": String(row),
    title: stageSentence(stage),
  });
  for (const [column] of columns) {
    const isText = column === "stage" || column === "reason";
    element.append(el("td", { class: isText ? "" : "number" }, cellText(run, column, row)));
  }
  element.addEventListener("click", choose);
  element.addEventListener("keydown", (event) => {
    if (event.key === "Enter") choose();
    const next =
      event.key === "ArrowDown"
        ? element.nextElementSibling
        : event.key === "ArrowUp"
          ? element.previousElementSibling
          : null;
    if (!(next instanceof HTMLElement)) return;
    event.preventDefault();
    event.stopPropagation();
    next.focus();
    next.click();
  });
  return element;
}
