/** Tracks on the earth: local metres for drawing, and files for other programs. */
import type { GeoTrack } from "./model";

export interface GeoPoint {
  latitude: number;
  longitude: number;
  height: number;
}

/** The frames that have a position; null where a frame without one interrupts the track. */
export function pointsOf({ track }: GeoTrack): (GeoPoint | null)[] {
  const points: (GeoPoint | null)[] = [];
  for (let i = 0; i < track.length; i += 3) {
    const known = Number.isFinite(track[i]);
    points.push(known ? { latitude: track[i], longitude: track[i + 1], height: track[i + 2] } : null);
  }
  return points;
}

/** Metres per degree of latitude and longitude at a latitude, by the radii of curvature of WGS84. */
export function metresPerDegree(latitude: number): [number, number] {
  const a = 6378137;
  const e2 = 6.69437999014e-3;
  const sin = Math.sin((latitude * Math.PI) / 180);
  const w2 = 1 - e2 * sin * sin;
  const meridian = (a * (1 - e2)) / w2 ** 1.5;
  const parallel = (a / Math.sqrt(w2)) * Math.cos((latitude * Math.PI) / 180);
  return [(meridian * Math.PI) / 180, (parallel * Math.PI) / 180];
}

/** Parts of a track without the frames that have no position. */
function parts(track: GeoTrack): GeoPoint[][] {
  const result: GeoPoint[][] = [[]];
  for (const point of pointsOf(track)) {
    if (point !== null) result[result.length - 1].push(point);
    else if (result[result.length - 1].length > 0) result.push([]);
  }
  return result.filter((part) => part.length > 0);
}

export function geoJson(name: string, track: GeoTrack): string {
  const coordinates = parts(track).map((part) => part.map((p) => [p.longitude, p.latitude, p.height]));
  return JSON.stringify({
    type: "Feature",
    properties: { name },
    geometry: { type: "MultiLineString", coordinates },
  });
}

/** GPX 1.1, without times: the clock of a recording need not be that of the day. */
export function gpx(name: string, track: GeoTrack, escape: (text: string) => string): string {
  const segments = parts(track).map((part) => {
    const points = part.map(
      (p) =>
        `<trkpt lat="${p.latitude.toFixed(8)}" lon="${p.longitude.toFixed(8)}"><ele>${p.height.toFixed(3)}</ele></trkpt>`,
    );
    return `<trkseg>\n${points.join("\n")}\n</trkseg>`;
  });
  return `<?xml version="1.0" encoding="UTF-8"?>
<gpx version="1.1" creator="placegraph" xmlns="http://www.topografix.com/GPX/1/1">
<trk><name>${escape(name)}</name>
${segments.join("\n")}
</trk>
</gpx>
`;
}
