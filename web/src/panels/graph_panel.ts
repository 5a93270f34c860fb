import { formatCount, formatNumber } from "../data/format";
import { type GraphData, label } from "../data/model";
import { el, facts, select } from "../page/dom";
import type { GraphShape, Store } from "../page/state";
import { figuresSection } from "./overview_panel";
import type { Panel, PanelContext } from "./panel";

const WORST = 100;

export function graphPanel({ report, store }: PanelContext): Panel {
  return {
    title: "Graph",
    available: report.graphs.length > 0,
    keys: ["graph", "graphShape", "edge", "edgeKind"],
    render: () => {
      const { state } = store;
      const graph = report.graphs[state.graph];
      const names = report.graphs.map((g, i) => ({ value: String(i), text: g.name }));
      return el(
        "div",
        {},
        el("h2", {}, graph.name),
        report.graphs.length > 1
          ? select("Pose graph", names, String(state.graph), (value) =>
              chooseGraph(store, report.graphs, Number(value)),
            )
          : null,
        graph.after
          ? shapeChoice(store)
          : el("p", { class: "soft" }, "The graph has not been optimized: its nodes are shown as they are."),
        graph.kind.table.length > 1 ? kindChoice(graph, store) : null,
        facts([
          ["Nodes", ofAll(graph.nodes, graph.allNodes)],
          ["Edges", ofAll(graph.edgeCount, graph.allEdges)],
        ]),
        figuresSection(graph.figures),
        el("h3", {}, "Edges with the largest chi2"),
        worstTable(graph, store),
      );
    },
  };
}

/** A number of which the page has some: nodes that are left out are joined with the one before. */
function ofAll(count: number, all: number): string {
  return count === all ? formatCount(all) : `${formatCount(all)}, ${formatCount(count)} of them in this page`;
}

function chooseGraph(store: Store, graphs: GraphData[], graph: number): void {
  store.set({ graph, edge: -1, edgeKind: null, graphShape: graphs[graph].after ? "after" : "before" });
}

function shapeChoice(store: Store): HTMLElement {
  return el(
    "label",
    {},
    "Show ",
    select(
      "Shape of the graph",
      [
        { value: "before", text: "before the optimization" },
        { value: "after", text: "after the optimization" },
        { value: "both", text: "both, the shape before in grey" },
      ],
      store.state.graphShape,
      (value) => store.set({ graphShape: value as GraphShape }),
    ),
  );
}

function kindChoice(graph: GraphData, store: Store): HTMLElement {
  const kinds = graph.kind.table.map((kind) => ({ value: kind, text: kind }));
  const choices = [{ value: "", text: "all kinds" }, ...kinds];
  return el(
    "label",
    {},
    "Edges of ",
    select("Kind of edges", choices, store.state.edgeKind ?? "", (value) =>
      store.set({ edgeKind: value === "" ? null : value, edge: -1 }),
    ),
  );
}

/** The edges with the largest chi2, of one kind or (null) of all. */
export function worstEdges(graph: GraphData, count: number, kind: string | null): number[] {
  const all = Array.from({ length: graph.edgeCount }, (_, i) => i);
  const edges = all.filter((edge) => kind === null || label(graph.kind, edge) === kind);
  const size = (i: number): number => (Number.isNaN(graph.chi2[i]) ? -Infinity : graph.chi2[i]);
  return edges.sort((a, b) => size(b) - size(a) || a - b).slice(0, count);
}

function worstTable(graph: GraphData, store: Store): HTMLElement {
  const titles = ["From", "To", "Kind", "chi2", ...(graph.weight ? ["Weight"] : [])];
  const body = el("tbody");
  for (const edge of worstEdges(graph, WORST, store.state.edgeKind)) {
    const cells = [
      String(graph.ends[2 * edge]),
      String(graph.ends[2 * edge + 1]),
      label(graph.kind, edge) ?? "unknown",
      formatNumber(graph.chi2[edge]),
    ];
    if (graph.weight) cells.push(formatNumber(graph.weight[edge], 2));
    const row = el(
      "tr",
      { tabindex: "0", "aria-current": String(edge === store.state.edge) },
      ...cells.map((text, i) => el("td", { class: i === 2 ? "" : "number" }, text)),
    );
    row.addEventListener("click", () => store.set({ edge }));
    row.addEventListener("keydown", (event) => {
      if (event.key === "Enter") store.set({ edge });
    });
    body.append(row);
  }
  return el(
    "table",
    { class: "loops" },
    el("thead", {}, el("tr", {}, ...titles.map((title, i) => el("th", { class: i === 2 ? "" : "number" }, title)))),
    body,
  );
}
