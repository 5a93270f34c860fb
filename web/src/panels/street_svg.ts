/** The street map as SVG text: classes from above, the path of the camera, a scale bar. */
import { cssColour } from "../data/colour_scale";
import type { RunData, StreetShape } from "../data/model";
import { positionAt } from "../data/quaternion";
import { isPosed } from "../data/run_view";
import { mainComponent } from "../data/compare";
import { formatCount } from "../data/format";
import { isPicture } from "../page/dom";
import { escapeXml } from "../save/graph_svg";
import { cellSize } from "../scene/grid_layer";

const SIZE = 640;
const MARGIN = 16;
const LINE = 16;

export function streetSvg(run: RunData, street: StreetShape): string {
  const scale = (SIZE - 2 * MARGIN) / Math.max(street.width, street.height);
  const width = Math.ceil(street.width * scale + 2 * MARGIN);
  const picture = Math.ceil(street.height * scale + 2 * MARGIN);
  const height = picture + 34 + LINE * street.classes.length;
  const image = isPicture(street.image) ? street.image : "";
  // Rows of the image go along z, which is up in the picture.
  const place = `translate(${MARGIN} ${picture - MARGIN}) scale(${scale.toFixed(6)} ${(-scale).toFixed(6)})`;
  const bar = cellSize(((SIZE / scale) * street.cell_m) / 2);
  const base = picture + 18;
  const right = (MARGIN + (bar / street.cell_m) * scale).toFixed(1);
  const parts = [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${Math.max(width, 320)}" height="${height}" font-family="sans-serif" font-size="13">`,
    `<rect width="100%" height="100%" fill="#ffffff"/>`,
    `<g transform="${place}"><image width="${street.width}" height="${street.height}" href="${image}" style="image-rendering:pixelated"/>`,
    `<path d="${pathOf(run, street)}" fill="none" stroke="#000000" stroke-width="2" vector-effect="non-scaling-stroke"/></g>`,
    `<path d="M${MARGIN} ${base - 6}V${base}H${right}V${base - 6}" fill="none" stroke="#000000"/>`,
    `<text x="${MARGIN + 4}" y="${base - 5}">${bar} m</text>`,
  ];
  street.classes.forEach((each, i) => {
    const y = base + LINE * (i + 1);
    parts.push(
      `<rect x="${MARGIN}" y="${y - 10}" width="18" height="10" fill="${cssColour(each.rgb)}"/>`,
      `<text x="${MARGIN + 26}" y="${y}">${escapeXml(each.name)}, ${formatCount(Math.round(each.area_m2))} m²</text>`,
    );
  });
  return `${parts.join("\n")}\n</svg>\n`;
}

/** The trajectory of the main component in pixels of the image. */
function pathOf(run: RunData, street: StreetShape): string {
  const R = street.R_plan_map;
  const main = mainComponent(run);
  let path = "";
  let before = false;
  for (let row = 0; row < run.frames.count; row++) {
    const posed = isPosed(run, row, main);
    if (posed) {
      const [x, y, z] = positionAt(run.frames.pose, row);
      const u = (R[0] * x + R[1] * y + R[2] * z - street.low_m[0]) / street.cell_m;
      const v = (R[6] * x + R[7] * y + R[8] * z - street.low_m[1]) / street.cell_m;
      path += `${before ? "L" : "M"}${u.toFixed(1)} ${v.toFixed(1)}`;
    }
    before = posed;
  }
  return path;
}
