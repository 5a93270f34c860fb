import { Box3, Group, Quaternion, Sphere, Vector3 } from "three";
import { type Rgb, robustRange, scaleColour, shareOf } from "../data/colour_scale";
import { type GraphData, label } from "../data/model";
import type { GraphShape } from "../page/state";
import { type LegendItem, scaleLegend } from "./colouring";
import { SegmentList, thinLines, wideLines } from "./lines";

const BEFORE: Rgb = [150, 150, 150];
const SELECTED: Rgb = [255, 64, 129];

/** chi2 has a wide range: its colours are on a logarithmic scale. */
export function chi2Range(graph: GraphData): [number, number] {
  const [low, high] = robustRange(graph.chi2, 0.05, 0.999);
  return [Math.max(low, high * 1e-4), high];
}

/** The edges of a pose graph before and after its optimization, coloured by chi2. */
export function graphLines(graph: GraphData, shape: GraphShape, kind: string | null, edge: number): Group {
  const group = new Group();
  group.quaternion.copy(upright(graph));
  const range = chi2Range(graph);
  const after = graph.after ?? graph.before;
  const nodes = shape === "before" ? graph.before : after;
  if (shape === "both")
    group.add(
      thinLines(
        edgeSegments(graph, graph.before, kind, () => BEFORE),
        0.5,
      ),
    );
  group.add(
    wideLines(
      edgeSegments(graph, nodes, kind, (i) => scaleColour("viridis", shareOf(graph.chi2[i], range, true))),
      2,
    ),
  );
  if (edge >= 0 && edge < graph.edgeCount) {
    const list = new SegmentList();
    list.add(nodes, 3 * graph.edges[2 * edge], nodes, 3 * graph.edges[2 * edge + 1], SELECTED);
    group.add(wideLines(list, 6, 5));
  }
  group.updateMatrixWorld(true);
  return group;
}

export function graphLegend(graph: GraphData): LegendItem {
  return scaleLegend("chi2 of edges, logarithmic", "viridis", chi2Range(graph), "", true);
}

function edgeSegments(
  graph: GraphData,
  nodes: ArrayLike<number>,
  kind: string | null,
  colour: (edge: number) => Rgb,
): SegmentList {
  const list = new SegmentList();
  for (let i = 0; i < graph.edgeCount; i++) {
    if (kind !== null && label(graph.kind, i) !== kind) continue;
    list.add(nodes, 3 * graph.edges[2 * i], nodes, 3 * graph.edges[2 * i + 1], colour(i));
  }
  return list;
}

/** Pose graphs name no vertical: the coordinate that varies least is taken for it; y points down as in cameras. */
function upright(graph: GraphData): Quaternion {
  const size = boundsOf(graph).getSize(new Vector3());
  const up = new Vector3(0, 1, 0);
  if (size.y <= size.x && size.y <= size.z) return new Quaternion(1, 0, 0, 0);
  const vertical = size.z <= size.x ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0);
  return new Quaternion().setFromUnitVectors(vertical, up);
}

function boundsOf(graph: GraphData): Box3 {
  const box = new Box3();
  const point = new Vector3();
  const nodes = graph.after ?? graph.before;
  for (let i = 0; i < nodes.length; i += 3) {
    if (Number.isFinite(nodes[i])) box.expandByPoint(point.fromArray(nodes, i));
  }
  return box;
}

export function graphSphere(graph: GraphData): Sphere {
  const box = boundsOf(graph);
  if (box.isEmpty()) return new Sphere(new Vector3(), 1);
  return box
    .getBoundingSphere(new Sphere())
    .applyMatrix4(new Group().matrix.makeRotationFromQuaternion(upright(graph)));
}

/** The middle of an edge in the scene. */
export function edgeMiddle(graph: GraphData, shape: GraphShape, edge: number): Vector3 {
  const nodes = shape === "before" ? graph.before : (graph.after ?? graph.before);
  const a = new Vector3().fromArray(nodes, 3 * graph.edges[2 * edge]);
  const b = new Vector3().fromArray(nodes, 3 * graph.edges[2 * edge + 1]);
  return a.add(b).multiplyScalar(0.5).applyQuaternion(upright(graph));
}
