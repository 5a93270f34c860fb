import { BufferAttribute, BufferGeometry, type Object3D, Points, PointsMaterial } from "three";
import { categoryColour, cssColour } from "../data/colour_scale";
import type { RunData } from "../data/model";
import { label } from "../data/model";
import { SegmentList, thinLines } from "./lines";

export const PLACE_COLOUR = categoryColour(4);

export function placePoints(run: RunData, component: number | null): Object3D {
  const { places } = run;
  const positions: number[] = [];
  for (let i = 0; i < places.count; i++) {
    if (component !== null && places.component[i] !== component) continue;
    positions.push(places.position[3 * i], places.position[3 * i + 1], places.position[3 * i + 2]);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  const size = 8 * Math.min(window.devicePixelRatio, 2);
  return new Points(geometry, new PointsMaterial({ color: cssColour(PLACE_COLOUR), sizeAttenuation: false, size }));
}

/** Constraints between places, coloured by their source. */
export function constraintLines(run: RunData, component: number | null): Object3D {
  const { places, constraints } = run;
  const list = new SegmentList();
  for (let i = 0; i < constraints.count; i++) {
    const a = places.rowOf.get(constraints.from[i]);
    const b = places.rowOf.get(constraints.to[i]);
    if (a === undefined || b === undefined) continue;
    if (component !== null && places.component[a] !== component) continue;
    if (places.component[a] !== places.component[b]) continue;
    list.add(places.position, 3 * a, places.position, 3 * b, constraintColour(run, label(constraints.source, i)));
  }
  return thinLines(list);
}

export function constraintColour(run: RunData, source: string | null): ReturnType<typeof categoryColour> {
  return categoryColour(run.constraints.source.table.indexOf(source ?? "") + 1);
}
