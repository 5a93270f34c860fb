/** A track on the earth as SVG text: north is up, with a graticule, a scale bar and its beginning and end. */
import { metresPerDegree, pointsOf } from "../data/geodesy";
import type { GeoTrack } from "../data/model";
import { cellSize } from "../scene/grid_layer";

const SIZE = 640;
const MARGIN = 92;

interface Frame {
  x(longitude: number): string;
  y(latitude: number): string;
  /** Bounds in degrees. */
  south: number;
  north: number;
  west: number;
  east: number;
  width: number;
  height: number;
  pixelsPerMetre: number;
}

export function earthSvg(track: GeoTrack): string {
  const frame = frameOf(track);
  const parts = [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${frame.width}" height="${frame.height}" font-family="sans-serif" font-size="16">`,
    `<rect width="100%" height="100%" fill="#ffffff"/>`,
    ...graticule(frame),
    `<path d="${pathOf(track, frame)}" fill="none" stroke="#0072b2" stroke-width="2.5" stroke-linejoin="round"/>`,
    ...ends(track, frame),
    ...scaleBar(frame),
    `<path d="M${frame.width - 22} 60V14l-7 13m7-13l7 13" fill="none" stroke="#000000" stroke-width="2"/>`,
    `<text x="${frame.width - 22}" y="78" text-anchor="middle">N</text>`,
  ];
  return `${parts.join("\n")}\n</svg>\n`;
}

function frameOf(track: GeoTrack): Frame {
  let [south, north, west, east] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const point of pointsOf(track)) {
    if (point === null) continue;
    south = Math.min(south, point.latitude);
    north = Math.max(north, point.latitude);
    west = Math.min(west, point.longitude);
    east = Math.max(east, point.longitude);
  }
  const [perLatitude, perLongitude] = metresPerDegree((south + north) / 2);
  const extent = Math.max((north - south) * perLatitude, (east - west) * perLongitude, 1);
  const pad = 0.06 * extent;
  south -= pad / perLatitude;
  north += pad / perLatitude;
  west -= pad / perLongitude;
  east += pad / perLongitude;
  const pixelsPerMetre = (SIZE - 2 * MARGIN) / (extent + 2 * pad);
  const height = (north - south) * perLatitude * pixelsPerMetre + 2 * MARGIN;
  return {
    x: (longitude) => (MARGIN + (longitude - west) * perLongitude * pixelsPerMetre).toFixed(1),
    y: (latitude) => (height - MARGIN - (latitude - south) * perLatitude * pixelsPerMetre).toFixed(1),
    south,
    north,
    west,
    east,
    width: Math.ceil((east - west) * perLongitude * pixelsPerMetre + 2 * MARGIN),
    height: Math.ceil(height),
    pixelsPerMetre,
  };
}

/** Multiples of a round step between two values, about three of them. */
export function gridValues(low: number, high: number): number[] {
  const step = cellSize((high - low) * 3);
  const values: number[] = [];
  for (let i = Math.ceil(low / step); i * step <= high; i++) values.push(i * step);
  return values;
}

/** Enough digits to tell the lines of a graticule apart. */
function degrees(value: number, span: number, positive: string, negative: string): string {
  const digits = Math.min(Math.max(Math.ceil(-Math.log10(span)) + 1, 2), 8);
  return `${Math.abs(value).toFixed(digits)}° ${value < 0 ? negative : positive}`;
}

function graticule(frame: Frame): string[] {
  const parts: string[] = [];
  const [left, right] = [frame.x(frame.west), frame.x(frame.east)];
  const [bottom, top] = [frame.y(frame.south), frame.y(frame.north)];
  for (const longitude of gridValues(frame.west, frame.east)) {
    const x = frame.x(longitude);
    const text = degrees(longitude, frame.east - frame.west, "E", "W");
    parts.push(
      `<path d="M${x} ${bottom}V${top}" stroke="#dddddd"/>`,
      `<text x="${x}" y="${Number(bottom) + 15}" text-anchor="middle" font-size="13">${text}</text>`,
    );
  }
  for (const latitude of gridValues(frame.south, frame.north)) {
    const y = frame.y(latitude);
    const text = degrees(latitude, frame.north - frame.south, "N", "S");
    parts.push(
      `<path d="M${left} ${y}H${right}" stroke="#dddddd"/>`,
      `<text x="${Number(left) - 4}" y="${Number(y) + 4}" text-anchor="end" font-size="13">${text}</text>`,
    );
  }
  parts.push(`<path d="M${left} ${bottom}V${top}H${right}V${bottom}Z" fill="none" stroke="#999999"/>`);
  return parts;
}

function pathOf(track: GeoTrack, frame: Frame): string {
  let path = "";
  let before = false;
  for (const point of pointsOf(track)) {
    if (point !== null) path += `${before ? "L" : "M"}${frame.x(point.longitude)} ${frame.y(point.latitude)}`;
    before = point !== null;
  }
  return path;
}

function ends(track: GeoTrack, frame: Frame): string[] {
  const points = pointsOf(track).filter((point) => point !== null);
  const mark = (i: number, colour: string, text: string): string[] => {
    const point = points.at(i);
    if (!point) return [];
    const [x, y] = [frame.x(point.longitude), frame.y(point.latitude)];
    return [
      `<circle cx="${x}" cy="${y}" r="6" fill="${colour}" stroke="#ffffff"/>`,
      `<text x="${Number(x) + 8}" y="${Number(y) + 4}">${text}</text>`,
    ];
  };
  return [...mark(0, "#009e73", "begin"), ...mark(-1, "#d55e00", "end")];
}

function scaleBar(frame: Frame): string[] {
  const metres = cellSize(((SIZE - 2 * MARGIN) / frame.pixelsPerMetre) * 2);
  const right = (MARGIN + metres * frame.pixelsPerMetre).toFixed(1);
  const y = frame.height - 18;
  return [
    `<path d="M${MARGIN} ${y - 6}V${y}H${right}V${y - 6}" fill="none" stroke="#000000"/>`,
    `<text x="${MARGIN + 4}" y="${y - 5}">${metres} m</text>`,
  ];
}
