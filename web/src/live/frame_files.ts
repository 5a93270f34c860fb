/** Images of the recording, and what the keyframes have observed in them. */
import { asObject } from "../data/fields";
import { readColumn } from "../data/table_reader";
import { getJson, request } from "./http";

export interface Observations {
  count: number;
  /** Two values a point, in pixels of the full image. */
  pixel: Float32Array;
  /** Row of the landmark in the report, or -1. */
  landmark: Int32Array;
}

/** The full image of frame id `frame` of run number `run`. */
export async function frameImage(run: number, frame: number): Promise<Blob> {
  return (await request(`runs/${run}/frames/${frame}/image.jpg`)).blob();
}

export async function frameObservations(run: number, frame: number): Promise<Observations> {
  return decodeObservations(await getJson(`runs/${run}/frames/${frame}/observations.json`));
}

export function decodeObservations(value: unknown): Observations {
  const { values, rows } = readColumn(asObject(value, "The observations")["points"], "points", 3);
  const pixel = new Float32Array(2 * rows);
  const landmark = new Int32Array(rows);
  for (let i = 0; i < rows; i++) {
    pixel[2 * i] = values[3 * i];
    pixel[2 * i + 1] = values[3 * i + 1];
    landmark[i] = values[3 * i + 2];
  }
  return { count: rows, pixel, landmark };
}

/** Index of the point nearest to (u, v) within `radius` pixels, or -1. */
export function nearestPoint({ pixel, count }: Observations, u: number, v: number, radius: number): number {
  let best = -1;
  let bestDistance = radius;
  for (let i = 0; i < count; i++) {
    const distance = Math.hypot(pixel[2 * i] - u, pixel[2 * i + 1] - v);
    if (distance >= bestDistance) continue;
    best = i;
    bestDistance = distance;
  }
  return best;
}

/** Puts the full image of a frame in the place of its thumbnail when it has come; without one the thumbnail stays. */
export function showFullImage(image: HTMLImageElement, run: number, frame: number): void {
  const full = new Image();
  full.src = `runs/${run}/frames/${frame}/image.jpg`;
  full.decode().then(
    () => (image.src = full.src),
    () => undefined,
  );
}
