import { formatNumber } from "../data/format";
import { el } from "../page/dom";
import type { Stage } from "./events";

/** Processor time of the stages as bars, the longest first. */
export function stageBars(stages: Stage[]): HTMLElement {
  if (stages.length === 0) return el("p", { class: "soft" }, "No stage has been timed yet.");
  const most = Math.max(...stages.map((stage) => stage.cpuS), 1e-9);
  const body = el("tbody");
  for (const { name, cpuS, calls } of [...stages].sort((a, b) => b.cpuS - a.cpuS)) {
    const bar = el("div", { class: "stage-bar" });
    bar.style.width = `${(100 * cpuS) / most}%`;
    const each = calls > 0 ? `${formatNumber((1000 * cpuS) / calls)} ms` : "–";
    body.append(
      el(
        "tr",
        {},
        el("td", {}, name.replaceAll("_", " ")),
        el("td", { class: "stage-cell" }, bar),
        el("td", { class: "number" }, `${formatNumber(cpuS)} s`),
        el("td", { class: "number" }, each),
      ),
    );
  }
  const titles = ["Stage", "", "In all", "A call"];
  const head = el("tr", {}, ...titles.map((title, i) => el("th", { class: i > 1 ? "number" : "" }, title)));
  return el("table", { class: "stages" }, el("thead", {}, head), body);
}
