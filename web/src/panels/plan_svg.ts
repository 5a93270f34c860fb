/** A floor plan as SVG text, with a scale bar. */
import { CATEGORIES, cssColour } from "../data/colour_scale";
import type { PlanShape } from "../data/model";
import { escapeXml } from "../save/graph_svg";
import { cellSize } from "../scene/grid_layer";

const SIZE = 640;
const MARGIN = 20;

export function planSvg(lines: PlanShape[]): string {
  const [low, high] = bounds(lines);
  const extent = Math.max(high[0] - low[0], high[1] - low[1], 1e-6);
  const scale = (SIZE - 2 * MARGIN) / extent;
  const x = (value: number): string => (MARGIN + (value - low[0]) * scale).toFixed(1);
  const y = (value: number): string => (MARGIN + (high[1] - value) * scale).toFixed(1);
  const names = [...new Set(lines.map((line) => line.label))];
  const height = Math.ceil((high[1] - low[1]) * scale + 2 * MARGIN + 34 + 16 * names.length);
  const parts = [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${SIZE}" height="${height}" viewBox="0 0 ${SIZE} ${height}" font-family="sans-serif" font-size="13">`,
    `<rect width="${SIZE}" height="${height}" fill="#ffffff"/>`,
  ];
  for (const line of lines) {
    const points: string[] = [];
    for (let i = 0; i + 1 < line.points.length; i += 2) points.push(`${x(line.points[i])} ${y(line.points[i + 1])}`);
    if (points.length === 0) continue;
    parts.push(
      `<path d="M${points.join("L")}${line.closed ? "Z" : ""}" fill="none" stroke="${colour(names.indexOf(line.label))}" stroke-width="2"/>`,
    );
  }
  const bar = cellSize(extent * 1.6);
  const base = height - 14 - 16 * names.length;
  parts.push(
    `<path d="M${MARGIN} ${base - 6}V${base}H${(MARGIN + bar * scale).toFixed(1)}V${base - 6}" fill="none" stroke="#000000"/>`,
  );
  parts.push(`<text x="${MARGIN}" y="${base - 9}">${bar} m</text>`);
  names.forEach((name, i) => {
    const at = base + 16 * (i + 1);
    parts.push(
      `<path d="M${MARGIN} ${at - 4}h18" stroke="${colour(i)}" stroke-width="3"/>`,
      `<text x="${MARGIN + 26}" y="${at}">${escapeXml(name)}</text>`,
    );
  });
  return `${parts.join("\n")}\n</svg>\n`;
}

function colour(index: number): string {
  return cssColour(CATEGORIES[(index + 5) % CATEGORIES.length]);
}

function bounds(lines: PlanShape[]): [[number, number], [number, number]] {
  const low: [number, number] = [Infinity, Infinity];
  const high: [number, number] = [-Infinity, -Infinity];
  for (const { points } of lines) {
    for (let i = 0; i < points.length; i++) {
      if (!Number.isFinite(points[i])) continue;
      low[i % 2] = Math.min(low[i % 2], points[i]);
      high[i % 2] = Math.max(high[i % 2], points[i]);
    }
  }
  return low[0] <= high[0]
    ? [low, high]
    : [
        [0, 0],
        [1, 1],
      ];
}
