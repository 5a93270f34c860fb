import { el } from "../page/dom";
import { TABS, type Store, type Tab } from "../page/state";
import type { Panel } from "./panel";

/** The side panel. Only the open tab is drawn; the others are drawn when they are opened. */
export function tabs(store: Store, panels: Record<Tab, Panel>): HTMLElement {
  const list = el("div", { class: "tabs", role: "tablist", "aria-label": "Panels" });
  const body = el("div", { class: "panel-body", role: "tabpanel", tabindex: "0" });
  const buttons = new Map<Tab, HTMLButtonElement>();
  const shown = TABS.filter((tab) => panels[tab].available);
  for (const tab of shown) {
    const element = el("button", { type: "button", role: "tab", id: `tab-${tab}` }, panels[tab].title);
    element.addEventListener("click", () => store.set({ tab }));
    // A click leaves the focus where it is: the arrow keys go on to move the cursor.
    element.addEventListener("mousedown", (event) => event.preventDefault());
    buttons.set(tab, element);
    list.append(element);
  }
  list.addEventListener("keydown", (event) => {
    const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (step === 0) return;
    event.stopPropagation();
    const tab = shown[(shown.indexOf(store.state.tab) + step + shown.length) % shown.length];
    store.set({ tab });
    buttons.get(tab)?.focus();
  });
  const draw = (scrollToTop: boolean): void => {
    const { tab } = store.state;
    for (const [name, element] of buttons) {
      element.setAttribute("aria-selected", String(name === tab));
      element.tabIndex = name === tab ? 0 : -1;
    }
    body.setAttribute("aria-labelledby", `tab-${tab}`);
    const top = body.scrollTop;
    const content = panels[tab].render();
    if (body.firstChild !== content) body.replaceChildren(content);
    body.scrollTop = scrollToTop ? 0 : top;
  };
  let pending = false;
  const drawSoon = (): void => {
    if (pending) return;
    pending = true;
    requestAnimationFrame(() => {
      pending = false;
      draw(false);
    });
  };
  store.on(["tab"], () => draw(true));
  for (const tab of shown) {
    store.on(panels[tab].keys, (state) => {
      if (state.tab === tab) drawSoon();
    });
  }
  draw(true);
  return el("aside", { class: "panel", "aria-label": "Details" }, list, body);
}
