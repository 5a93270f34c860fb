import { cssColour } from "../data/colour_scale";
import { formatCount, formatNumber, formatPercent, formatTime, plural } from "../data/format";
import { type LoopColumn, filterLoops, sortLoops, stageCounts, stageOf, stageSentence } from "../data/loops";
import type { RunData } from "../data/model";
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
const COLUMNS: [LoopColumn, string][] = [
  ["query", "Query"],
  ["match", "Match"],
  ["stage", "Stage"],
  ["probability", "Prob."],
  ["similarity", "Sim."],
  ["inliers", "Inliers"],
  ["lines", "Lines"],
];

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
    served?.editor ? loopButtons(served.editor, run, loop) : null,
    facts([
      ["Probability of the same place", formatPercent(loops.probability[loop])],
      ["Similarity", formatNumber(loops.similarity[loop])],
      ["Inliers", formatNumber(loops.inliers[loop])],
      ["Lines", formatNumber(loops.lines[loop])],
      ["Time between the two", timeBetween(run, loop)],
    ]),
  );
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
  const uri = row === undefined ? undefined : run.keyframes.thumbnails[keyframeAt(run, row)];
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
  const box = el("fieldset", { class: "filters" }, el("legend", {}, "Stages"));
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
  const least = el("output", {}, formatNumber(loopFilter.minProbability));
  const probability = slider("Probability at least", 0, 1, 0.05, loopFilter.minProbability, (minProbability) => {
    least.textContent = formatNumber(minProbability);
    store.set({ loopFilter: { ...store.state.loopFilter, minProbability } });
  });
  probability.append(least);
  box.append(probability);
  return box;
}

function table({ report, store }: PanelContext, run: RunData): HTMLElement {
  const { loopFilter, loopOrder, loop } = store.state;
  const rows = sortLoops(run.loops, filterLoops(run.loops, loopFilter), loopOrder);
  const head = el("tr");
  for (const [column, title] of COLUMNS) {
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
    body.append(tableRow(run, row, row === loop, () => store.set(loopSelection(report, store.state, row))));
  const more =
    rows.length > ROWS
      ? el("p", { class: "soft" }, `The first ${ROWS} are in the table; filter or sort to see others.`)
      : null;
  return el(
    "div",
    {},
    el("p", {}, `${plural(rows.length, "loop candidate")} of ${formatCount(run.loops.count)}`),
    el("table", { class: "loops" }, el("thead", {}, head), body),
    more,
  );
}

function tableRow(run: RunData, row: number, selected: boolean, choose: () => void): HTMLElement {
  const { loops } = run;
  const stage = stageOf(loops, row);
  const cells = [
    String(loops.query[row]),
    String(loops.match[row]),
    stage,
    formatNumber(loops.probability[row], 2),
    formatNumber(loops.similarity[row], 2),
    formatNumber(loops.inliers[row]),
    formatNumber(loops.lines[row]),
  ];
  const element = el("tr", {
    tabindex: "0",
    "aria-current": String(selected),
    "data-loop": String(row),
    title: stageSentence(stage),
  });
  cells.forEach((text, i) => element.append(el("td", { class: i === 2 ? "" : "number" }, text)));
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
