import type { Table } from "../data/report";
import { el } from "../page/dom";

/** A table of a report: its first column names the rows, the others hold values. */
export function tableSection(table: Table): HTMLElement {
  const cell = (tag: "td" | "th", text: string, i: number): HTMLElement =>
    el(tag, { class: i > 0 ? "number" : "" }, text);
  const head = el("thead", {}, el("tr", {}, ...table.columns.map((text, i) => cell("th", text, i))));
  const body = el("tbody", {}, ...table.rows.map((row) => el("tr", {}, ...row.map((text, i) => cell("td", text, i)))));
  return el(
    "section",
    {},
    el("h3", {}, table.title),
    el("div", { class: "wide" }, el("table", {}, head, body)),
    el("p", { class: "soft" }, table.protocol),
  );
}
