import uPlot from "uplot";
import { formatNumber } from "../data/format";
import { el } from "../page/dom";

/** Distance between two runs over their common frames, with the threshold as a dashed line. */
export function distanceGraph(
  ids: number[],
  distance: Float64Array,
  threshold: number,
  width: number,
  onFrame: (id: number) => void,
): HTMLElement {
  const box = el("div", { class: "graph", role: "img", "aria-label": "Graph of the distance between the two runs" });
  requestAnimationFrame(() => {
    const style = getComputedStyle(box);
    const ink = style.getPropertyValue("--ink-soft").trim() || "#888";
    const grid = { stroke: style.getPropertyValue("--line").trim() || "#444", width: 1 };
    const values = (_: uPlot, ticks: number[]): string[] => ticks.map((tick) => formatNumber(tick));
    const limit = ids.map(() => threshold);
    const plot = new uPlot(
      {
        width,
        height: 150,
        legend: { show: false },
        cursor: { show: false },
        scales: { x: { time: false } },
        axes: [
          { stroke: ink, grid, ticks: grid, size: 26, values },
          { stroke: ink, grid, ticks: grid, size: 52, space: 24, values },
        ],
        series: [
          {},
          { stroke: "rgb(230, 159, 0)", width: 1.5, points: { show: false } },
          { stroke: ink, dash: [6, 4], width: 1, points: { show: false } },
        ],
      },
      [ids, distance, limit],
      box,
    );
    plot.over.addEventListener("click", (event) => onFrame(plot.posToVal(event.offsetX, "x")));
  });
  return box;
}
