import type { Graph } from "../src/data/report";
import { column, labels } from "./encode";
import { Random } from "./random";

/** A pose graph on a grid-like spiral: `after` is its true shape, `before` has drifted. */
export function sampleGraph(nodes = 800, seed = 3, name = "spiral.g2o"): Graph {
  const random = new Random(seed);
  const after: number[] = [];
  const before: number[] = [];
  let bend = 0;
  for (let i = 0; i < nodes; i++) {
    const angle = i / 18;
    const radius = 4 + i * 0.02;
    after.push(radius * Math.cos(angle), radius * Math.sin(angle), 0);
    bend += random.normal(0.002) + 0.0006;
    before.push(radius * Math.cos(angle + bend) + i * 0.01, radius * Math.sin(angle + bend), 0);
  }
  const edges: number[] = [];
  const kinds: string[] = [];
  const chi2: number[] = [];
  const add = (a: number, b: number, kind: string, value: number): void => {
    edges.push(a, b);
    kinds.push(kind);
    chi2.push(value);
  };
  for (let i = 0; i + 1 < nodes; i++) add(i, i + 1, "odometry", 0.5 * random.normal() ** 2);
  for (let i = 130; i < nodes; i += 9) add(i, i - 113, "loop", 2 * random.normal() ** 2);
  add(10, nodes - 20, "loop", 412.5);
  return {
    name,
    before: column("f32", before, 3),
    after: column("f32", after, 3),
    edges: column("i32", edges, 2),
    edge_kind: labels(kinds),
    chi2: column("f32", chi2),
    weight: column(
      "f32",
      chi2.map((value) => 1 / (1 + value / 10)),
    ),
    figures: [
      { name: "chi2 before", value: 18234.2, unit: "", protocol: "sum over all edges" },
      { name: "chi2 after", value: chi2.reduce((a, b) => a + b, 0), unit: "", protocol: "sum over all edges" },
    ],
  };
}
