/** Edits of the loops of a map that the program serves. */
import { decodeReport } from "../data/decode";
import { asBoolean, asObject, asText, listOf } from "../data/fields";
import type { ReportData } from "../data/model";
import { getJson, postJson } from "../live/http";

export type Edit =
  | { action: "refuse" | "accept" | "add"; query_frame: number; match_frame: number }
  | { action: "optimize" | "undo" }
  | { action: "save"; name: string };

export interface EditList {
  /** A sentence for each edit, in order. */
  edits: string[];
  /** Whether there are edits that no saved map has. */
  unsaved: boolean;
  /** Whether the place graph was optimized after the last edit. */
  optimized: boolean;
}

export function decodeEdits(value: unknown): EditList {
  const json = asObject(value, "The edits");
  return {
    edits: listOf(json["edits"], "edits", asText),
    unsaved: asBoolean(json["unsaved"], "unsaved"),
    optimized: asBoolean(json["optimized"], "optimized"),
  };
}

/** What is said beside the button of the last action. */
export interface EditMessage {
  action: Edit["action"];
  text: string;
  fault: boolean;
}

/** The name of a new map: what every file system takes and no path can be made of. */
export function isMapName(name: string): boolean {
  return /^[A-Za-z0-9_-]{1,64}$/.test(name);
}

/** The program asks for the later frame first; nothing for one and the same frame. */
export function loopBetween(a: number, b: number): Edit | null {
  return a === b ? null : { action: "add", query_frame: Math.max(a, b), match_frame: Math.min(a, b) };
}

/** The program says what was done in a line without a capital and a full stop. */
export function sentence(line: string): string {
  const begun = line.slice(0, 1).toUpperCase() + line.slice(1);
  return /[.!?]$/.test(begun) ? begun : `${begun}.`;
}

/** The loop that an edit is about, so that it is selected afterwards. */
export function editedLoop(edit: Edit): { query: number; match: number } | null {
  return "query_frame" in edit ? { query: edit.query_frame, match: edit.match_frame } : null;
}

/** Sends edits, one at a time, and reads the report again after each. */
export class Editor {
  list: EditList = { edits: [], unsaved: false, optimized: true };
  message: EditMessage | null = null;
  /** The action that the program works on, or null. */
  busy: Edit["action"] | null = null;
  /** Called with the report after an edit. */
  onReport: (report: ReportData, edit: Edit) => void = () => undefined;
  private readonly listeners: (() => void)[] = [];

  /** Calls `call` after each change of what the editor says. */
  on(call: () => void): void {
    this.listeners.push(call);
  }

  async load(): Promise<void> {
    this.list = decodeEdits(await getJson("edits.json"));
  }

  async send(edit: Edit): Promise<void> {
    if (this.busy !== null) return;
    this.busy = edit.action;
    this.message = null;
    this.changed();
    try {
      const answer = await postJson("edits", edit);
      this.list = decodeEdits(answer);
      this.message = {
        action: edit.action,
        text: sentence(asText(asObject(answer, "The answer")["text"], "text")),
        fault: false,
      };
      if (edit.action !== "save") this.onReport(decodeReport(await getJson("report.json")), edit);
    } catch (error) {
      const text = sentence(error instanceof Error ? error.message : "The edit cannot be made.");
      this.message = { action: edit.action, text, fault: true };
    }
    this.busy = null;
    this.changed();
  }

  private changed(): void {
    for (const call of this.listeners) call();
  }
}
