/** Elements of the page. Texts are set as text, never as HTML. */

type Child = Node | string | null;

export interface Attributes {
  class?: string;
  title?: string;
  /** Any other attribute. */
  [name: string]: string | undefined;
}

export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== undefined) element.setAttribute(name, value);
  }
  for (const child of children) if (child !== null) element.append(child);
  return element;
}

export function button(text: string, title: string, onClick: () => void): HTMLButtonElement {
  const element = el("button", { type: "button", title }, text);
  element.addEventListener("click", onClick);
  return element;
}

export interface Choice {
  value: string;
  text: string;
}

export function select(
  label: string,
  choices: Choice[],
  value: string,
  onChange: (value: string) => void,
): HTMLSelectElement {
  const element = el("select", { "aria-label": label, title: label });
  for (const choice of choices) element.append(new Option(choice.text, choice.value));
  element.value = value;
  element.addEventListener("change", () => {
    onChange(element.value);
    leaveAfterPointer(element);
  });
  return element;
}

/** After a choice with the mouse, the arrow keys move the cursor again. */
function leaveAfterPointer(element: HTMLElement): void {
  if (!element.matches(":focus-visible")) element.blur();
}

export function checkbox(text: string, checked: boolean, onChange: (checked: boolean) => void): HTMLLabelElement {
  const input = el("input", { type: "checkbox" });
  input.checked = checked;
  input.addEventListener("change", () => onChange(input.checked));
  return el("label", { class: "check" }, input, text);
}

export function slider(
  label: string,
  low: number,
  high: number,
  step: number,
  value: number,
  onInput: (value: number) => void,
): HTMLLabelElement {
  const input = el("input", {
    type: "range",
    min: String(low),
    max: String(high),
    step: String(step),
    "aria-label": label,
  });
  input.value = String(value);
  input.addEventListener("input", () => onInput(Number(input.value)));
  input.addEventListener("change", () => leaveAfterPointer(input));
  return el("label", { class: "slider" }, el("span", {}, label), input);
}

export function facts(rows: [string, string | Node][]): HTMLElement {
  const list = el("dl", { class: "facts" });
  for (const [name, value] of rows) list.append(el("dt", {}, name), el("dd", {}, value));
  return list;
}

/** A thumbnail of the report is a picture in a data URI and nothing else. */
export function isPicture(uri: string | undefined): uri is string {
  return uri !== undefined && /^data:image\/(jpeg|png|webp);base64,[A-Za-z0-9+/=]+$/.test(uri);
}

export function svgUri(svg: string): string {
  return `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
}
