import { SCALES, cssColour } from "../data/colour_scale";
import { el } from "../page/dom";
import type { LegendItem } from "./colouring";

/** On a phone the legend would hide the scene: it is closed at first. */
function wide(): boolean {
  return window.matchMedia("(min-width: 801px)").matches;
}

/** The user can close it, as it lies over the scene. */
export function legendElement(items: LegendItem[], open = wide()): HTMLDetailsElement {
  const elements = items.map((item) => (item.kind === "scale" ? scaleElement(item) : categoryElement(item)));
  const box = el(
    "details",
    { class: "legend" },
    el("summary", {}, "Legend"),
    el("div", { class: "legend-body" }, ...elements),
  );
  box.hidden = items.length === 0;
  box.open = open;
  return box;
}

function scaleElement(item: Extract<LegendItem, { kind: "scale" }>): HTMLElement {
  const bar = el("div", { class: "scale-bar" });
  bar.style.background = `linear-gradient(to right, ${SCALES[item.scale].map((c) => cssColour(c)).join(", ")})`;
  const title = item.unit === "" ? item.title : `${item.title} [${item.unit}]`;
  return el(
    "div",
    {},
    el("div", {}, title),
    bar,
    el("div", { class: "scale-ends" }, el("span", {}, item.low), el("span", {}, item.high)),
  );
}

function categoryElement(item: Extract<LegendItem, { kind: "category" }>): HTMLElement {
  const box = el("div", { class: item.entries.length > 0 ? "lines" : "" });
  if (item.title !== "") box.append(el("div", {}, item.title));
  for (const entry of item.entries) {
    const mark = el("span", { class: "mark" });
    mark.style.background = cssColour(entry.colour);
    box.append(el("div", { class: "entry" }, mark, entry.text));
  }
  return box;
}

const LINE = 16;

/** Draws the legend into a saved picture, in its lower left corner. */
export function drawLegend(
  context: CanvasRenderingContext2D,
  items: LegendItem[],
  height: number,
  dark: boolean,
): void {
  const titled = (item: LegendItem): number => (item.title === "" ? 0 : 1);
  const lines = items.reduce((sum, item) => sum + titled(item) + (item.kind === "scale" ? 2 : item.entries.length), 0);
  let y = height - 12 - lines * LINE;
  context.fillStyle = dark ? "rgba(13, 17, 23, 0.75)" : "rgba(255, 255, 255, 0.8)";
  context.fillRect(8, y - 8, 250, lines * LINE + 12);
  context.font = "12px sans-serif";
  context.textBaseline = "top";
  const ink = dark ? "#e6edf3" : "#1a1f24";
  const write = (text: string, x: number): void => {
    context.fillStyle = ink;
    context.fillText(text, x, y);
  };
  for (const item of items) {
    write(item.kind === "scale" && item.unit !== "" ? `${item.title} [${item.unit}]` : item.title, 16);
    y += titled(item) * LINE;
    if (item.kind === "scale") {
      const gradient = context.createLinearGradient(16, 0, 236, 0);
      SCALES[item.scale].forEach((c, i, all) => gradient.addColorStop(i / (all.length - 1), cssColour(c)));
      context.fillStyle = gradient;
      context.fillRect(16, y + 2, 220, 10);
      y += LINE;
      write(item.low, 16);
      write(item.high, 236 - context.measureText(item.high).width);
      y += LINE;
      continue;
    }
    for (const entry of item.entries) {
      context.fillStyle = cssColour(entry.colour);
      context.fillRect(16, y + 5, 14, 4);
      write(entry.text, 36);
      y += LINE;
    }
  }
}
