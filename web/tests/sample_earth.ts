/** A synthetic street map and track on the earth. */
import type { Run } from "../src/data/report";
import { column } from "./encode";
import type { Drive } from "./sample_drive";
import { encodePixels } from "./png";

const TILE = 16;

/** Cells of 0.5 m: road within 4 m of the path, and a row of buildings beside it. */
export function sampleStreet(path: Drive): NonNullable<Run["street_map"]> {
  const cell = 0.5;
  const low: [number, number] = [-path.halfWidth - 16, -16];
  const columns = Math.ceil((2 * path.halfWidth + 32) / cell / TILE);
  const rows = Math.ceil((2 * path.halfDepth + 32) / cell / TILE);
  const [width, height] = [columns * TILE, rows * TILE];
  const pixels = new Uint8Array(4 * width * height);
  const paint = (x: number, z: number, radius: number, rgba: number[]): void => {
    const [u, v] = [Math.floor((x - low[0]) / cell), Math.floor((z - low[1]) / cell)];
    for (let dv = -radius; dv <= radius; dv++)
      for (let du = -radius; du <= radius; du++)
        if (u + du >= 0 && u + du < width && v + dv >= 0 && v + dv < height)
          pixels.set(rgba, 4 * ((v + dv) * width + u + du));
  };
  for (const { x, z } of path.truth) paint(x, z, 14, [128, 0, 0, 255]);
  for (const { x, z } of path.truth) paint(x, z, 8, [128, 64, 128, 255]);
  const ground: number[] = [];
  for (let row = 0; row <= rows; row++)
    for (let column = 0; column <= columns; column++)
      ground.push(low[0] + column * TILE * cell, 1.6, low[1] + row * TILE * cell);
  return {
    image: `data:image/png;base64,${encodePixels(width, height, pixels).toString("base64")}`,
    width,
    height,
    cell_m: cell,
    low_m: low,
    R_plan_map: column("f32", [1, 0, 0, 0, 1, 0, 0, 0, 1], 3),
    columns,
    rows,
    ground: column("f32", ground, 3),
    classes: [
      { name: "road", rgb: [128, 64, 128], area_m2: 900.4 },
      { name: "building", rgb: [128, 0, 0], area_m2: 300 },
    ],
  };
}

/** The path with z to the north, near Karlsruhe; the first frame has no position. */
export function sampleEarth(path: Drive): NonNullable<Run["georeference"]> {
  const [latitude, longitude] = [49.01, 8.43];
  const track = path.truth.flatMap(({ x, z }, frame) =>
    frame === 0 ? [NaN, NaN, NaN] : [latitude + z / 111200, longitude + x / 73100, 115.5],
  );
  return {
    latitude_deg: latitude,
    longitude_deg: longitude,
    folder: "/data/runs/block/georeference",
    fixes_used: 1000,
    fixes_rejected: 3,
    residual_rms_m: 0.31,
    track: column("f64", track, 3),
  };
}
