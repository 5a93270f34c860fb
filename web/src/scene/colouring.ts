/** The colour of each frame, and the legend that explains it. */
import {
  type Rgb,
  UNKNOWN_COLOUR,
  categoryColour,
  robustRange,
  scaleColour,
  shareOf,
  type ScaleName,
} from "../data/colour_scale";
import { formatNumber } from "../data/format";
import type { RunData } from "../data/model";
import { lengthUnit, series } from "../data/series";
import type { ColourBy } from "../page/state";

export type LegendItem =
  | { kind: "scale"; title: string; scale: ScaleName; low: string; high: string; unit: string }
  | { kind: "category"; title: string; entries: { text: string; colour: Rgb }[] };

export interface Colouring {
  colour(row: number): Rgb;
  legend: LegendItem;
}

export function scaleLegend(
  title: string,
  scale: ScaleName,
  [low, high]: [number, number],
  unit: string,
  above: boolean,
): LegendItem {
  return {
    kind: "scale",
    title,
    scale,
    low: formatNumber(low),
    high: `${above ? "≥ " : ""}${formatNumber(high)}`,
    unit,
  };
}

export function runColour(index: number): Rgb {
  return categoryColour(index);
}

export function frameColouring(run: RunData, runIndex: number, by: ColourBy): Colouring {
  if (by === "run") {
    const colour = runColour(runIndex);
    return { colour: () => colour, legend: { kind: "category", title: "Run", entries: [{ text: run.name, colour }] } };
  }
  if (by === "component") {
    const colourOf = new Map(run.components.map((component, i) => [component.number, categoryColour(i)]));
    return {
      colour: (row) => colourOf.get(run.frames.component[row]) ?? UNKNOWN_COLOUR,
      legend: {
        kind: "category",
        title: "Component",
        entries: run.components.map((component, i) => ({
          text: `${component.number}${component.main ? " (main)" : ""}`,
          colour: categoryColour(i),
        })),
      },
    };
  }
  const { title, unit, values } = series(run, by);
  const range = by === "confidence" ? ([0, 1] as [number, number]) : robustRange(values, 0, by === "time" ? 1 : 0.98);
  const above = by !== "confidence" && by !== "time";
  return {
    colour: (row) => scaleColour("viridis", shareOf(values[row], range)),
    legend: scaleLegend(title, "viridis", range, unit, above),
  };
}

/** Heights of points above the lowest ones, for their colour and legend. */
export function heightLegend(run: RunData, range: [number, number]): LegendItem {
  return scaleLegend("Height of landmarks", "cividis", range, lengthUnit(run), true);
}
