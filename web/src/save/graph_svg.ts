/** A graph as an SVG text, with axes and units, for papers. */
import { formatNumber } from "../data/format";

export interface SvgCurve {
  name: string;
  colour: string;
  values: ArrayLike<number>;
}

const WIDTH = 900;
const HEIGHT = 320;
const BOX = { left: 70, right: 20, top: 34, bottom: 46 };

export function graphSvg(
  title: string,
  xTitle: string,
  yTitle: string,
  xs: ArrayLike<number>,
  curves: SvgCurve[],
  range: [number, number],
): string {
  const [low, high] = valueRange(xs, curves, range);
  const x = (value: number): number =>
    BOX.left + ((value - range[0]) / (range[1] - range[0])) * (WIDTH - BOX.left - BOX.right);
  const y = (value: number): number =>
    HEIGHT - BOX.bottom - ((value - low) / (high - low)) * (HEIGHT - BOX.top - BOX.bottom);
  const parts = [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${WIDTH}" height="${HEIGHT}" viewBox="0 0 ${WIDTH} ${HEIGHT}" font-family="sans-serif" font-size="12">`,
    `<rect width="${WIDTH}" height="${HEIGHT}" fill="#ffffff"/>`,
    text(WIDTH / 2, 20, title, "middle"),
    text(WIDTH / 2, HEIGHT - 8, xTitle, "middle"),
    `<g transform="translate(16 ${HEIGHT / 2}) rotate(-90)">${text(0, 0, yTitle, "middle")}</g>`,
  ];
  for (const tick of ticks(low, high)) {
    parts.push(
      `<path d="M${BOX.left} ${y(tick).toFixed(1)}H${WIDTH - BOX.right}" stroke="#dddddd"/>`,
      text(BOX.left - 6, y(tick) + 4, formatNumber(tick), "end"),
    );
  }
  for (const tick of ticks(...range)) parts.push(text(x(tick), HEIGHT - BOX.bottom + 16, formatNumber(tick), "middle"));
  for (const curve of curves)
    parts.push(
      `<path d="${path(xs, curve.values, range, x, y)}" fill="none" stroke="${escapeXml(curve.colour)}" stroke-width="1.5"/>`,
    );
  curves.forEach((curve, i) =>
    parts.push(
      `<g fill="${escapeXml(curve.colour)}">${text(WIDTH - BOX.right, BOX.top + 14 * i, curve.name, "end")}</g>`,
    ),
  );
  return `${parts.join("\n")}\n</svg>\n`;
}

export function escapeXml(value: string): string {
  return value.replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
}

function text(x: number, y: number, value: string, anchor: string): string {
  return `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" text-anchor="${anchor}">${escapeXml(value)}</text>`;
}

function valueRange(xs: ArrayLike<number>, curves: SvgCurve[], range: [number, number]): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (const { values } of curves) {
    for (let i = 0; i < values.length; i++) {
      if (!Number.isFinite(values[i]) || xs[i] < range[0] || xs[i] > range[1]) continue;
      low = Math.min(low, values[i]);
      high = Math.max(high, values[i]);
    }
  }
  if (low > high) return [0, 1];
  return low === high ? [low - 0.5, high + 0.5] : [low, high];
}

/** About five round values between two others. */
export function ticks(low: number, high: number): number[] {
  const target = (high - low) / 5;
  const power = 10 ** Math.floor(Math.log10(target));
  const step = ([1, 2, 5, 10].find((factor) => factor * power >= target) ?? 10) * power;
  const result: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9; k++)
    result.push(Number((k * step).toPrecision(12)));
  return result;
}

/** The curve with gaps; of the points in each half pixel of its width, the least and the greatest value. */
function path(
  xs: ArrayLike<number>,
  values: ArrayLike<number>,
  range: [number, number],
  x: (v: number) => number,
  y: (v: number) => number,
): string {
  let result = "";
  let drawing = false;
  let column: number[] = []; // indices of its points
  const add = (): void => {
    for (const i of extremes(column, values)) {
      result += `${drawing ? "L" : "M"}${x(xs[i]).toFixed(1)} ${y(values[i]).toFixed(1)}`;
      drawing = true;
    }
    column = [];
  };
  const half = (i: number): number => Math.floor(2 * x(xs[i]));
  for (let i = 0; i < values.length; i++) {
    const there = Number.isFinite(values[i]) && xs[i] >= range[0] && xs[i] <= range[1];
    if (column.length > 0 && (!there || half(i) !== half(column[0]))) add();
    if (there) column.push(i);
    else drawing = false;
  }
  add();
  return result;
}

/** The indices of the least and of the greatest value, in their order; all of no more than two. */
function extremes(indices: number[], values: ArrayLike<number>): number[] {
  if (indices.length <= 2) return indices;
  let [least, greatest] = [indices[0], indices[0]];
  for (const i of indices) {
    if (values[i] < values[least]) least = i;
    if (values[i] > values[greatest]) greatest = i;
  }
  return least === greatest ? [least] : [Math.min(least, greatest), Math.max(least, greatest)];
}
