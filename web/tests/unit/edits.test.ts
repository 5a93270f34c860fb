import { afterEach, describe, expect, it, vi } from "vitest";
import { decodeReport } from "../../src/data/decode";
import type { ReportData } from "../../src/data/model";
import { type Edit, Editor, decodeEdits, editedLoop, isMapName, loopBetween } from "../../src/edit/editor";
import { findLoop, replaceReport } from "../../src/edit/replace_report";
import { startState } from "../../src/page/start_state";
import { Store } from "../../src/page/state";
import { column, labels } from "../encode";
import { sampleReport, sampleRun } from "../sample";

function reportWith(stage: string, shift = 0): ReportData {
  const run = sampleRun({ frames: 50, landmarks: 0, thumbnails: false, loops: false });
  run.loops = {
    query_frame: column("i32", [40, 45]),
    match_frame: column("i32", [3, 8]),
    probability: column("f32", [0.9, 0.4]),
    similarity: column("f32", [0.9, 0.4]),
    inliers: column("i32", [70, 9]),
    lines: column("i32", [0, 0]),
    stage: labels([stage, "geometry"]),
    reason: null,
    rank: null,
    judged: false,
  };
  const report = decodeReport(sampleReport([run]));
  const { pose } = report.runs[0].frames;
  for (let i = 0; i < pose.length; i += 7) pose[i] += shift;
  return report;
}

/** A program that gives one answer after the other. */
function answers(...list: [number, unknown][]): { method: string; path: string; body: unknown }[] {
  const asked: { method: string; path: string; body: unknown }[] = [];
  vi.stubGlobal("fetch", async (path: string, options: RequestInit = {}) => {
    asked.push({ method: options.method ?? "GET", path, body: JSON.parse(String(options.body ?? "null")) as unknown });
    const [status, body] = list.shift() ?? [500, ""];
    return new Response(JSON.stringify(body), { status });
  });
  return asked;
}

afterEach(() => vi.unstubAllGlobals());

describe("the editor", () => {
  const refuse: Edit = { action: "refuse", query_frame: 40, match_frame: 3 };
  const list = { edits: ["refused the loop of frames 40 and 3"], unsaved: true, optimized: false };

  it("sends an edit, takes the list and the report after it", async () => {
    const asked = answers(
      [200, { text: "refused the loop", ...list }],
      [200, sampleReport([sampleRun({ frames: 10, landmarks: 0 })])],
    );
    const editor = new Editor();
    const reports: number[] = [];
    editor.onReport = (report) => reports.push(report.runs[0].frames.count);
    await editor.send(refuse);
    expect(asked[0]).toEqual({ method: "POST", path: "edits", body: refuse });
    expect(asked[1].path).toBe("report.json");
    expect(editor.list).toEqual(list);
    expect(editor.message).toEqual({ action: "refuse", text: "Refused the loop.", fault: false });
    expect(reports).toEqual([10]);
  });

  it("keeps all as it was and says why where an edit cannot be made", async () => {
    answers([409, { error: "no geometric agreement: 9 inliers of 20 needed" }]);
    const editor = new Editor();
    editor.onReport = () => expect.unreachable();
    await editor.send({ action: "add", query_frame: 9, match_frame: 2 });
    expect(editor.list.edits).toEqual([]);
    expect(editor.message).toEqual({
      action: "add",
      text: "No geometric agreement: 9 inliers of 20 needed.",
      fault: true,
    });
    expect(editor.busy).toBeNull();
  });

  it("sends one edit at a time, and says while it is busy", async () => {
    const asked = answers([200, { text: "Saved.", edits: [], unsaved: false, optimized: true }]);
    const editor = new Editor();
    const busy: (string | null)[] = [];
    editor.on(() => busy.push(editor.busy));
    await Promise.all([editor.send({ action: "save", name: "mended" }), editor.send(refuse)]);
    expect(asked).toHaveLength(1);
    expect(busy).toEqual(["save", null]);
  });

  it("does not read the report after saving", async () => {
    const asked = answers([200, { text: "Saved.", edits: [], unsaved: false, optimized: true }]);
    await new Editor().send({ action: "save", name: "mended" });
    expect(asked.map(({ path }) => path)).toEqual(["edits"]);
  });

  it("takes plain names only", () => {
    for (const name of ["mended", "town_2", "a-B"]) expect(isMapName(name)).toBe(true);
    for (const name of ["", "../x", "a b", "a.db", "ä", "x".repeat(65)]) expect(isMapName(name)).toBe(false);
  });

  it("names the later frame of a loop first", () => {
    expect(loopBetween(3, 40)).toEqual({ action: "add", query_frame: 40, match_frame: 3 });
    expect(loopBetween(40, 3)).toEqual({ action: "add", query_frame: 40, match_frame: 3 });
    expect(loopBetween(3, 3)).toBeNull();
    expect(editedLoop(refuse)).toEqual({ query: 40, match: 3 });
    expect(editedLoop({ action: "undo" })).toBeNull();
  });

  it("says what is wrong with a damaged list", () => {
    expect(() => decodeEdits({ edits: [1], unsaved: true, optimized: true })).toThrow("edits[0]");
  });
});

describe("a report after an edit", () => {
  it("takes the place of the one before; the choices stay", () => {
    const report = reportWith("accepted");
    const store = new Store({ ...startState(report, "dark"), row: 20, loop: 0 });
    const drawn: number[] = [];
    store.on(["run"], ({ loop }) => drawn.push(loop));
    replaceReport(report, store, reportWith("hand"), null);
    expect(drawn).toEqual([0]);
    expect(store.state.row).toBe(20);
    expect(store.state.loopFilter.stages.has("hand")).toBe(true);
    expect(report.runs[0].loops.stage.table).toContain("hand");
    expect(report.runs[0].before).toBeUndefined();
  });

  it("keeps the poses from before if they have moved, until the next edit", () => {
    const report = reportWith("accepted");
    const store = new Store(startState(report, "dark"));
    const x = report.runs[0].frames.pose[7 * 30];
    replaceReport(report, store, reportWith("accepted", 2), null);
    expect(report.runs[0].before?.[7 * 30]).toBe(x);
    replaceReport(report, store, reportWith("hand", 2), null);
    expect(report.runs[0].before).toBeUndefined();
  });

  it("selects the loop that the edit is about, whichever of its frames comes first", () => {
    const report = reportWith("accepted");
    const store = new Store(startState(report, "dark"));
    replaceReport(report, store, reportWith("accepted"), { query: 8, match: 45 });
    expect(store.state.loop).toBe(1);
    expect(findLoop(report.runs[0], 1, 2)).toBe(-1);
  });

  it("shows a stage that the user has hidden no more than before", () => {
    const report = reportWith("accepted");
    const store = new Store(startState(report, "dark"));
    store.set({ loopFilter: { stages: new Set(["accepted"]), minProbability: 0 } });
    replaceReport(report, store, reportWith("accepted"), null);
    expect(store.state.loopFilter.stages.has("geometry")).toBe(false);
  });
});
