import { describe, expect, it } from "vitest";
import { decodeColumn } from "../../src/data/column";
import { decodeReport } from "../../src/data/decode";
import { label } from "../../src/data/model";
import { travelled } from "../../src/data/series";
import { column, labels } from "../encode";
import { sampleGraph, sampleReport, sampleRun } from "../sample";

const small = { frames: 60, landmarks: 40, thumbnails: false };

describe("a column", () => {
  it("returns the values that were encoded, for each type", () => {
    expect([...decodeColumn(column("f32", [0.5, -2]), "c").values]).toEqual([0.5, -2]);
    expect([...decodeColumn(column("f64", [1.6e9 + 0.1]), "c").values]).toEqual([1.6e9 + 0.1]);
    expect([...decodeColumn(column("i32", [-1, 70000]), "c").values]).toEqual([-1, 70000]);
    expect([...decodeColumn(column("u8", [0, 255]), "c").values]).toEqual([0, 255]);
    expect(decodeColumn(column("f32", [1, 2, 3, 4, 5, 6], 3), "c").rows).toBe(2);
  });

  it("with a part of a row is an error that names it", () => {
    expect(() => decodeColumn(column("f32", [1, 2, 3, 4], 3), "runs[0].pose")).toThrow(
      "runs[0].pose has 16 bytes, which is no multiple of 12 bytes a row.",
    );
  });

  it("that is no base64 is an error", () => {
    expect(() => decodeColumn({ type: "u8", width: 1, data: "?" }, "c")).toThrow("c is not valid base64.");
  });
});

describe("a report", () => {
  it("is decoded with all its tables", () => {
    const report = decodeReport(
      JSON.parse(
        JSON.stringify(sampleReport([sampleRun({ ...small, lost: [[20, 24]], components: 2 })], [sampleGraph(150)])),
      ),
    );
    const [run] = report.runs;
    expect(run.frames.count).toBe(60);
    expect(run.frames.rowOf.get(59)).toBe(59);
    expect(run.frames.component[22]).toBe(-1);
    expect(label(run.frames.reason, 22)).toBe("too few points agree with the motion");
    expect(label(run.frames.reason, 0)).toBeNull();
    expect(run.components.map((component) => component.main)).toEqual([true, false]);
    expect(run.landmarks.count).toBe(40);
    expect(report.graphs[0].edges.length).toBe(2 * report.graphs[0].edgeCount);
  });

  it("of a thinned graph has the numbers of the whole one", () => {
    const graph = { ...sampleGraph(), all: { nodes: 90000, edges: 95000 } };
    const whole = decodeReport(sampleReport([], [sampleGraph(), graph])).graphs;
    expect(whole[0].allNodes).toBe(whole[0].nodes);
    expect(whole[0].ends).toBe(whole[0].edges);
    expect(whole[1].allNodes).toBe(90000);
    expect(whole[1].allEdges).toBe(95000);
  });

  it("of a thinned run has the path length of all frames", () => {
    const run = sampleRun(small);
    const thinned = { ...run, summary: { ...run.summary, path_length: 1234.5 } };
    expect(travelled(decodeReport(sampleReport([thinned])).runs[0])).toBe(1234.5);
  });

  it("of another format is refused", () => {
    expect(() => decodeReport({ format: "placegraph-report-2" })).toThrow(
      'The report has the format "placegraph-report-2"; this page shows placegraph-report-1.',
    );
    expect(() => decodeReport(null)).toThrow("The report is missing or is no object.");
  });

  it("without a column, or with one of another size, names the column", () => {
    const run = sampleRun(small);
    const without = { ...run, frames: { ...run.frames, keyframe: undefined } };
    expect(() => decodeReport(sampleReport([without as never]))).toThrow(
      "runs[0].frames.keyframe is missing or is no object.",
    );
    const short = { ...run, frames: { ...run.frames, inliers: column("i32", [1, 2]) } };
    expect(() => decodeReport(sampleReport([short]))).toThrow("runs[0].frames.inliers has 2 rows; it must have 60.");
    const narrow = { ...run, frames: { ...run.frames, pose: column("f32", [1, 2, 3], 3) } };
    expect(() => decodeReport(sampleReport([narrow]))).toThrow(
      "runs[0].frames.pose has 3 values a row; it must have 7.",
    );
    const images = { ...run, keyframes: { ...run.keyframes, thumbnails: [] } };
    expect(() => decodeReport(sampleReport([images]))).toThrow(
      /runs\[0\]\.keyframes\.thumbnails has 0 rows; it must have \d+\./,
    );
  });

  it("with an unknown word where a choice is needed names the choices", () => {
    const run = { ...sampleRun(small), sensor: "sonar" };
    expect(() => decodeReport(sampleReport([run as never]))).toThrow(
      'runs[0].sensor is "sonar"; it must be one of mono, stereo, rgbd.',
    );
  });

  it("with an edge to a node that is not there is refused", () => {
    const graph = { ...sampleGraph(150), before: column("f32", [0, 0, 0], 3), after: null };
    expect(() => decodeReport(sampleReport([], [graph]))).toThrow(
      "graphs[0].edges names node 1, but there are 1 nodes.",
    );
  });

  it("may lack what is optional", () => {
    const run = sampleRun({ ...small, truth: false });
    const bare = {
      ...run,
      judgement: null,
      camera: null,
      frames: { ...run.frames, sigma_m: null, confidence: null, environment: null },
      landmarks: { ...run.landmarks, colour: null, sigma_m: null },
    };
    const decoded = decodeReport(sampleReport([bare])).runs[0];
    expect(decoded.frames.truth).toBeNull();
    expect(decoded.landmarks.colour).toBeNull();
    expect(decoded.camera).toBeNull();
  });

  it("keeps labels of a table that no row uses", () => {
    expect(labels(["b", null], ["a"]).table).toEqual(["a", "b"]);
  });
});
