/** The landmarks that a keyframe sees, over its thumbnail, with their way through the keyframes before. */
import { cssColour, scaleColour } from "../data/colour_scale";
import type { RunData } from "../data/model";

const SVG = "http://www.w3.org/2000/svg";
/** Keyframes that a drawn track goes back at most. */
const LONGEST = 6;

/** The points of each landmark in a keyframe (row `k`) and in those before it, the newest first. */
export function tracksOf(run: RunData, k: number): [number, number][][] {
  const { tracks } = run.keyframes;
  if (tracks === null || k < 0) return [];
  const order = run.keyframes.byFrame;
  const at = order.indexOf(k);
  const found = new Map<number, [number, number][]>();
  for (let back = 0; back < LONGEST && at - back >= 0; back++) {
    const row = order[at - back];
    for (let i = tracks.first[row]; i < tracks.first[row + 1]; i++) {
      const point: [number, number] = [tracks.pixel[2 * i] / 255, tracks.pixel[2 * i + 1] / 255];
      const track = found.get(tracks.landmark[i]);
      if (back === 0) found.set(tracks.landmark[i], [point]);
      else if (track?.length === back) track.push(point);
    }
  }
  return [...found.values()];
}

/** An overlay for an image of `width` x `height` pixels; null where nothing is known. */
export function tracksOverlay(run: RunData, k: number, width: number, height: number): SVGSVGElement | null {
  const tracks = tracksOf(run, k);
  if (tracks.length === 0) return null;
  const root = document.createElementNS(SVG, "svg");
  root.setAttribute("viewBox", `0 0 ${width} ${height}`);
  root.setAttribute("class", "tracks");
  root.setAttribute("aria-hidden", "true");
  const radius = Math.max(width, height) / 170;
  for (const points of tracks) {
    const colour = cssColour(scaleColour("viridis", (points.length - 1) / (LONGEST - 1)));
    const [x, y] = points[0];
    const line = document.createElementNS(SVG, "path");
    line.setAttribute("d", `M${points.map(([u, v]) => `${u * width} ${v * height}`).join("L")}`);
    line.setAttribute("stroke", colour);
    line.setAttribute("stroke-width", String(radius / 1.5));
    line.setAttribute("fill", "none");
    const dot = document.createElementNS(SVG, "circle");
    dot.setAttribute("cx", String(x * width));
    dot.setAttribute("cy", String(y * height));
    dot.setAttribute("r", String(radius));
    dot.setAttribute("fill", colour);
    dot.setAttribute("stroke", "#ffffff");
    dot.setAttribute("stroke-width", String(radius / 3));
    root.append(line, dot);
  }
  return root;
}
