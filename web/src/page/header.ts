import type { ReportData } from "../data/model";
import { runColour } from "../scene/colouring";
import { cssColour } from "../data/colour_scale";
import { button, el, select } from "./dom";
import { chooseRun } from "./start_state";
import type { Store } from "./state";
import { toggleTheme } from "./theme";

const VERDICTS = { good: "good", doubtful: "doubtful", failed: "failed" };

/** `note` is what stands behind the verdict. */
export function header(
  report: ReportData,
  store: Store,
  toggleHelp: () => void,
  note: HTMLElement | null,
): HTMLElement {
  const verdict = el("span", { class: "verdict" });
  const mark = el("span", { class: "mark" });
  const runs = select(
    "Run",
    report.runs.map((run, i) => ({ value: String(i), text: run.name })),
    "0",
    (value) => store.set(chooseRun(report, store.state, Number(value))),
  );
  runs.hidden = report.runs.length < 2;
  mark.hidden = runs.hidden;
  const show = (): void => {
    const run = report.runs[store.state.run];
    runs.value = String(store.state.run);
    mark.style.background = cssColour(runColour(store.state.run));
    verdict.hidden = !run?.judgement;
    if (!run?.judgement) return;
    verdict.textContent = VERDICTS[run.judgement.verdict];
    verdict.className = `verdict ${run.judgement.verdict}`;
  };
  store.on(["run"], show);
  show();
  return el(
    "header",
    {},
    el("h1", {}, report.title),
    mark,
    runs,
    verdict,
    note,
    el("span", { class: "gap" }),
    button("◐", "Dark or light (D)", () => toggleTheme(store)),
    button("?", "Keys and mouse (?)", toggleHelp),
  );
}
