import type { Object3D } from "three";
import { categoryColour } from "../data/colour_scale";
import type { RunData } from "../data/model";
import { label } from "../data/model";
import { discs } from "./discs";
import { SegmentList, thinLines } from "./lines";

export const PLACE_COLOUR = categoryColour(4);

export function placePoints(run: RunData, component: number | null): Object3D {
  const { places } = run;
  const positions: number[] = [];
  for (let i = 0; i < places.count; i++) {
    if (component !== null && places.component[i] !== component) continue;
    positions.push(places.position[3 * i], places.position[3 * i + 1], places.position[3 * i + 2]);
  }
  return discs(positions, PLACE_COLOUR, 9);
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
