import type { Store, Theme } from "./state";

export function preferredTheme(): Theme {
  return window.matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark";
}

export function toggleTheme(store: Store): void {
  store.set({ theme: store.state.theme === "dark" ? "light" : "dark" });
}

export function showTheme(theme: Theme): void {
  document.documentElement.dataset["theme"] = theme;
}

/** The theme of the system holds until the user chooses another. */
export function watchTheme(store: Store): void {
  const apply = (): void => showTheme(store.state.theme);
  store.on(["theme"], apply);
  apply();
  window
    .matchMedia("(prefers-color-scheme: light)")
    .addEventListener("change", () => store.set({ theme: preferredTheme() }));
}
