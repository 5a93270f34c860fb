import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, Object3D } from "three";
import type { Rgb } from "../data/colour_scale";
import { wideLineMesh } from "./wide_lines";

/** Segments collected one by one, with a colour at each end. */
export class SegmentList {
  readonly positions: number[] = [];
  readonly colours: number[] = [];

  add(a: ArrayLike<number>, atA: number, b: ArrayLike<number>, atB: number, colourA: Rgb, colourB = colourA): void {
    this.positions.push(a[atA], a[atA + 1], a[atA + 2], b[atB], b[atB + 1], b[atB + 2]);
    for (const c of [colourA, colourB]) this.colours.push(c[0] / 255, c[1] / 255, c[2] / 255);
  }
}

export function thinLines(list: SegmentList, opacity = 1): LineSegments {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(list.positions), 3));
  geometry.setAttribute("color", new BufferAttribute(new Float32Array(list.colours), 3));
  const material = new LineBasicMaterial({ vertexColors: true, transparent: opacity < 1, opacity });
  material.depthWrite = opacity === 1;
  return new LineSegments(geometry, material);
}

/** Lines of `width` pixels; those with a positive `order` are drawn over everything of a lower one. */
export function wideLines(list: SegmentList, width: number, order = 0): Object3D {
  return list.positions.length === 0 ? new Object3D() : wideLineMesh(list.positions, list.colours, width, order);
}

/** Frees what an object and its children hold on the graphics card. */
export function dispose(object: Object3D): void {
  object.removeFromParent();
  object.traverse((child) => {
    const { geometry, material } = child as Partial<LineSegments>;
    geometry?.dispose();
    for (const one of Array.isArray(material) ? material : [material]) one?.dispose();
  });
}
