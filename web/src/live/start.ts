/** The page as it is served: it reads its report from the program, and follows a run until it has one. */
import { decodeReport } from "../data/decode";
import type { ReportData } from "../data/model";
import { el } from "../page/dom";
import type { Theme } from "../page/state";
import { Editor } from "../edit/editor";
import { ServerFault, getLargeJson } from "./http";
import { LivePage } from "./live_page";
import type { LiveStart } from "./live_start";

/** What a served page can do beyond one in a file. */
export interface Served {
  /** Null where nothing can be edited. */
  editor: Editor | null;
  /** Null: that of the system. */
  theme: Theme | null;
}

type Show = (page: HTMLElement, report: ReportData, served: Served) => void;
type Say = (page: HTMLElement, text: string) => void;

export function startLive(page: HTMLElement, start: LiveStart, show: Show, say: Say): void {
  document.title = `${start.title} – ${start.program}`;
  if (start.kind === "run") followRun(page, start, show);
  else void showMap(page, start, show, say);
}

async function showMap(page: HTMLElement, start: LiveStart, show: Show, say: Say): Promise<void> {
  const bar = el("progress", { "aria-label": "Progress" });
  const text = el("p", { role: "status" }, `The map of ${start.title} is read.`);
  page.className = "message waiting";
  page.replaceChildren(el("div", {}, text, bar));
  try {
    const report = await readReport((share, words) => {
      if (share !== null) bar.value = share;
      text.textContent = `The map of ${start.title} is read: ${words}.`;
    });
    const editor = start.editable ? new Editor() : null;
    await editor?.load();
    page.replaceChildren();
    show(page, report, { editor, theme: null });
  } catch (error) {
    say(page, `This map cannot be shown. ${error instanceof Error ? error.message : "The fault is unknown."}`);
  }
}

function followRun(page: HTMLElement, start: LiveStart, show: Show): void {
  const live = new LivePage(page, start, () => void finish());
  const finish = async (): Promise<void> => {
    live.say("The run is done. Its report is read.");
    try {
      const report = await readReport((_, words) => live.say(`The run is done. Its report is read: ${words}.`));
      const theme = live.close();
      page.replaceChildren();
      show(page, report, { editor: null, theme });
    } catch (error) {
      const none = error instanceof ServerFault && error.status === 404;
      const why = error instanceof Error ? error.message : "The fault is unknown.";
      live.say(
        none ? `The run is done and has no report. ${why}` : `The run is done. Its report cannot be shown. ${why}`,
      );
    }
  };
}

/** `onProgress` gets the share of the report that has come, null if it is unknown, and the same in words. */
async function readReport(onProgress: (share: number | null, words: string) => void): Promise<ReportData> {
  const megabytes = (bytes: number): string => (bytes / 1e6).toFixed(1);
  const json = await getLargeJson("report.json", (bytes, all) => {
    const of = all === null ? "" : ` of ${megabytes(all)}`;
    onProgress(all === null ? null : Math.min(bytes / all, 1), `${megabytes(bytes)}${of} MB`);
  });
  return decodeReport(json);
}
