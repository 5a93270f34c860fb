/** The graph of one series over the axis, drawn by uPlot. */
import uPlot from "uplot";
import type { Series } from "../data/series";
import { formatNumber } from "../data/format";
import type { Axis } from "./axis";
import { LEFT, RIGHT } from "./axis";

export interface Curve {
  name: string;
  colour: string;
  values: Float64Array;
}

export class Graph {
  private plot: uPlot | null = null;

  constructor(private readonly parent: HTMLElement) {}

  /** Draws `curves`, each with one value a frame of the axis. */
  show(
    shown: Series,
    curves: Curve[],
    axis: Axis,
    range: [number, number],
    size: { width: number; height: number },
  ): void {
    this.plot?.destroy();
    const style = getComputedStyle(this.parent);
    const ink = style.getPropertyValue("--ink-soft").trim() || "#888";
    const line = style.getPropertyValue("--line").trim() || "#444";
    const grid = { stroke: line, width: 1 };
    const options: uPlot.Options = {
      ...size,
      legend: { show: false },
      cursor: { show: false },
      padding: [8, RIGHT, 0, 0],
      scales: { x: { time: false, min: range[0], max: range[1] } },
      axes: [
        {
          stroke: ink,
          grid,
          ticks: grid,
          size: 26,
          values: (_, ticks) => ticks.map((t) => (axis.kind === "time" ? `${formatNumber(t)} s` : formatNumber(t))),
        },
        {
          stroke: ink,
          grid,
          ticks: grid,
          size: LEFT,
          space: 24,
          values: (_, ticks) => ticks.map((t) => formatNumber(t)),
        },
      ],
      series: [
        {},
        ...curves.map((curve) => ({ label: curve.name, stroke: curve.colour, width: 1.5, points: { show: false } })),
      ],
    };
    const data: uPlot.AlignedData = [axis.values, ...curves.map((curve) => nulls(curve.values))];
    this.plot = new uPlot(options, data, this.parent);
    this.plot.root.setAttribute("role", "img");
    this.plot.root.setAttribute("aria-label", `Graph of ${shown.title.toLowerCase()}`);
  }

  setRange([min, max]: [number, number]): void {
    this.plot?.setScale("x", { min, max });
  }

  resize(width: number, height: number): void {
    this.plot?.setSize({ width, height });
  }

  canvas(): HTMLCanvasElement | null {
    return this.plot?.root.querySelector("canvas") ?? null;
  }
}

/** uPlot leaves gaps where a value is null. */
export function nulls(values: Float64Array): (number | null)[] {
  return Array.from(values, (value) => (Number.isFinite(value) ? value : null));
}
