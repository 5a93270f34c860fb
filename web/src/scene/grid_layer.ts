import { GridHelper } from "three";

/** A round cell size, 1, 2 or 5 times a power of ten, near an eighth of `radius`. */
export function cellSize(radius: number): number {
  const target = Math.max(radius / 8, 1e-6);
  const power = 10 ** Math.floor(Math.log10(target));
  const step = [5, 2, 1].find((factor) => factor * power <= target) ?? 1;
  return Number((step * power).toPrecision(1));
}

export function ground(radius: number, height: number, x: number, z: number, dark: boolean): GridHelper {
  const cell = cellSize(radius);
  const cells = 2 * Math.ceil((1.6 * radius) / cell);
  const grid = new GridHelper(cells * cell, cells, dark ? 0x4a5560 : 0xaab4bd, dark ? 0x2a323a : 0xd4dae0);
  grid.position.set(Math.round(x / cell) * cell, height, Math.round(z / cell) * cell);
  return grid;
}
