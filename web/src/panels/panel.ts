import type { ReportData } from "../data/model";
import type { Served } from "../live/start";
import type { State, Store } from "../page/state";

export interface PanelContext {
  report: ReportData;
  store: Store;
  /** Null in a page that no program serves. */
  served: Served | null;
}

/** One tab: its content and the parts of the state after which it is drawn again. */
export interface Panel {
  title: string;
  available: boolean;
  keys: (keyof State)[];
  render(): Node;
}
