/** Edits of the loops: buttons for the selected loop, a loop between two frames, the list of edits, saving. */
import type { ReportData, RunData } from "../data/model";
import { keyframeAt } from "../data/run_view";
import { stageOf } from "../data/loops";
import { button, el, isPicture } from "../page/dom";
import type { Store } from "../page/state";
import { plural } from "../data/format";
import { showFullImage } from "../live/frame_files";
import { type Edit, type EditMessage, type Editor, isMapName, loopBetween } from "./editor";

/** Refuses or accepts the selected loop. */
export function loopButtons(editor: Editor, run: RunData, loop: number): HTMLElement {
  const accepted = stageOf(run.loops, loop) === "accepted";
  const action = accepted ? "refuse" : "accept";
  const edit: Edit = { action, query_frame: run.loops.query[loop], match_frame: run.loops.match[loop] };
  return el(
    "div",
    { class: "row" },
    actionButton(
      editor,
      edit,
      accepted ? "Refuse this loop" : "Accept this loop",
      accepted ? "Take this loop out of the map" : "Make this candidate a loop of the map after all",
    ),
    messageOf(editor, ["refuse", "accept"]),
  );
}

function actionButton(editor: Editor, edit: Edit, text: string, title: string): HTMLButtonElement {
  const working = editor.busy === edit.action;
  const element = button(working ? `${text} …` : text, title, () => void editor.send(edit));
  element.disabled = editor.busy !== null;
  return element;
}

/** What was said to the last of these actions. */
function messageOf(editor: Editor, actions: EditMessage["action"][]): HTMLElement | null {
  const { message, busy } = editor;
  if (busy !== null && actions.includes(busy))
    return el("span", { class: "soft", role: "status" }, "The program works on it.");
  if (message === null || !actions.includes(message.action)) return null;
  return el(
    "span",
    { class: message.fault ? "fault" : "soft", role: message.fault ? "alert" : "status" },
    message.text,
  );
}

/** The section of the loops panel that holds what does not belong to one loop. */
export class EditPanel {
  readonly element: HTMLDetailsElement;
  private readonly summary = el("summary");
  private readonly body = el("div");
  private edits = 0;
  private picked: number | null = null;
  private readonly name = el("input", {
    type: "text",
    "aria-label": "Name of the new map",
    placeholder: "name of the new map",
    maxlength: "64",
    spellcheck: "false",
  });

  constructor(
    private readonly editor: Editor,
    private readonly report: ReportData,
    private readonly store: Store,
  ) {
    this.element = el("details", { class: "edits" }, this.summary, this.body);
    this.name.addEventListener("input", () => this.draw());
    this.name.addEventListener("keydown", (event) => {
      if (event.key === "Enter" && isMapName(this.name.value))
        void editor.send({ action: "save", name: this.name.value });
    });
    editor.on(() => this.draw());
    store.on(["run", "row"], () => this.draw());
    this.draw();
  }

  private draw(): void {
    const focused = document.activeElement === this.name;
    const { edits, unsaved } = this.editor.list;
    if (edits.length > this.edits) this.element.open = true;
    this.edits = edits.length;
    const state = edits.length === 0 ? "" : `: ${plural(edits.length, "edit")}${unsaved ? ", not saved ●" : ", saved"}`;
    this.summary.textContent = `Mend the map${state}`;
    this.body.replaceChildren(
      el("h4", {}, "Add a loop between two frames"),
      ...this.adding(),
      el("h4", {}, "Edits"),
      this.optimizing(),
      edits.length === 0
        ? el(
            "p",
            { class: "soft" },
            "None. The recording and the map of the run stay as they are, whatever you edit here.",
          )
        : el("ol", { class: "edit-list" }, ...edits.map((text) => el("li", {}, text))),
      this.saving(),
    );
    if (focused) this.name.focus();
  }

  private adding(): Node[] {
    const { editor, store } = this;
    const run = this.report.runs[store.state.run];
    if (!run || run.frames.count === 0) return [];
    const id = run.frames.id[store.state.row];
    const pick = button(`Pick frame ${id}`, "Pick the frame under the cursor as one end of the loop", () => {
      this.picked = id;
      this.draw();
    });
    if (this.picked === null) {
      const how = "Pick one frame, move the cursor to the other, and add the loop.";
      return [el("div", { class: "row" }, pick, el("span", { class: "soft" }, how))];
    }
    const edit = loopBetween(this.picked, id);
    const add = edit
      ? actionButton(
          editor,
          edit,
          `Add the loop ${this.picked} – ${id}`,
          "Add a loop between the picked frame and the frame under the cursor",
        )
      : el("span", { class: "soft" }, "Move the cursor to the other frame.");
    const forget = button("Forget", "Forget the picked frame", () => {
      this.picked = null;
      this.draw();
    });
    return [
      el("div", { class: "pair" }, this.view(run, this.picked, "Picked"), this.view(run, id, "Under the cursor")),
      el("div", { class: "row" }, add, pick, forget, messageOf(editor, ["add"])),
    ];
  }

  private readonly views = new Map<string, { frame: number; run: RunData; element: HTMLElement }>();

  /** The image of a frame; it stays in the page while the frame is the same. */
  private view(run: RunData, frame: number, title: string): HTMLElement {
    const known = this.views.get(title);
    if (known?.frame === frame && known.run === run) return known.element;
    const uri = run.keyframes.thumbnails[keyframeAt(run, run.frames.rowOf.get(frame) ?? 0)];
    const image = el("img", { alt: `Image of frame ${frame}` });
    if (isPicture(uri)) image.src = uri;
    showFullImage(image, this.store.state.run, frame);
    const element = el("figure", {}, image, el("figcaption", {}, `${title}: frame ${frame}`));
    this.views.set(title, { frame, run, element });
    return element;
  }

  private optimizing(): HTMLElement {
    const { editor } = this;
    const { edits, optimized } = editor.list;
    const undo = actionButton(editor, { action: "undo" }, "Undo", "Take back the last edit");
    undo.disabled ||= edits.length === 0;
    return el(
      "div",
      { class: "row" },
      actionButton(
        editor,
        { action: "optimize" },
        "Optimize",
        "Optimize the place graph again, with the loops as they are now",
      ),
      undo,
      optimized ? null : el("span", { class: "soft" }, "The map is not optimized since the last edit."),
      messageOf(editor, ["optimize", "undo"]),
    );
  }

  private saving(): HTMLElement {
    const { editor, name } = this;
    const valid = isMapName(name.value);
    const save = actionButton(
      editor,
      { action: "save", name: name.value },
      "Save as a new map",
      "Write a map of this name beside that of the run",
    );
    save.disabled ||= !valid;
    const hint = name.value !== "" && !valid ? "A name has only letters, digits, - and _." : "";
    return el(
      "div",
      { class: "row" },
      name,
      save,
      hint === "" ? messageOf(editor, ["save"]) : el("span", { class: "fault", role: "alert" }, hint),
    );
  }
}

/** The browser asks before it leaves a page with edits that are not saved; the header tells of them. */
export function watchUnsaved(editor: Editor): HTMLElement {
  const mark = el(
    "span",
    { class: "unsaved", title: "There are edits that no map holds: see the loops" },
    "● edits not saved",
  );
  const show = (): void => {
    mark.hidden = !editor.list.unsaved;
  };
  editor.on(show);
  show();
  window.addEventListener("beforeunload", (event) => {
    if (editor.list.unsaved) event.preventDefault();
  });
  return mark;
}
