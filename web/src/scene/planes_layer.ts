import {
  BufferGeometry,
  Color,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineLoop,
  Mesh,
  MeshBasicMaterial,
  Vector2,
  Vector3,
  ShapeUtils,
} from "three";
import type { Values } from "../data/column";
import type { PlaneShape, RunData } from "../data/model";

export function planeShapes(run: RunData): Group {
  const group = new Group();
  for (const plane of run.planes) if (plane.outline.length >= 9) group.add(...shapesOf(plane));
  return group;
}

function shapesOf(plane: PlaneShape): [Mesh, LineLoop] {
  const outline = pointsOf(plane.outline);
  const holes = plane.holes.map(pointsOf);
  const geometry = new BufferGeometry().setFromPoints([...outline, ...holes.flat()]);
  geometry.setIndex(triangles(outline, holes));
  const border = new BufferGeometry().setFromPoints(outline);
  const color = colourOf(plane.rgb);
  const fill = new MeshBasicMaterial({ color, transparent: true, opacity: 0.16, side: DoubleSide, depthWrite: false });
  return [
    new Mesh(geometry, fill),
    new LineLoop(border, new LineBasicMaterial({ color, transparent: true, opacity: 0.7 })),
  ];
}

function pointsOf(values: Values): Vector3[] {
  const points: Vector3[] = [];
  for (let i = 0; i < values.length; i += 3) points.push(new Vector3().fromArray(values, i));
  return points;
}

/** Colours in 0..255; those in 0..1 are accepted too. */
function colourOf(rgb: [number, number, number]): Color {
  const scale = Math.max(...rgb) > 1 ? 255 : 1;
  return new Color(rgb[0] / scale, rgb[1] / scale, rgb[2] / scale);
}

/** Triangles of a plane polygon: it is divided in the two coordinates in which it is largest. */
function triangles(points: Vector3[], holes: Vector3[][]): number[] {
  const normal = new Vector3();
  points.forEach((p, i) => {
    const q = points[(i + 1) % points.length];
    normal.add(new Vector3().crossVectors(p, q));
  });
  const [x, y, z] = [Math.abs(normal.x), Math.abs(normal.y), Math.abs(normal.z)];
  const flat = (p: Vector3): Vector2 =>
    z >= x && z >= y ? new Vector2(p.x, p.y) : y >= x ? new Vector2(p.z, p.x) : new Vector2(p.y, p.z);
  return ShapeUtils.triangulateShape(
    points.map(flat),
    holes.map((hole) => hole.map(flat)),
  ).flat();
}
