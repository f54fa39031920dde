// Elements without a framework. Text from data goes through textContent alone.
type Child = Node | string | null | undefined | false;
type Attributes = Record<string, string | number | boolean | null | undefined | ((e: any) => void)>;

function fill(element: Element, attributes: Attributes, children: Child[]): void {
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === "function") element.addEventListener(key, value);
    else element.setAttribute(key, value === true ? "" : String(value));
  }
  for (const child of children) {
    if (child || child === "") element.append(child);
  }
}

// h("button", { class: "quiet", click: () => … }, "Reset"): a function is a listener, false leaves the attribute out.
export function h<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  fill(element, attributes, children);
  return element;
}

export function svg(tag: string, attributes: Attributes = {}, ...children: Child[]): SVGElement {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  fill(element, attributes, children);
  return element;
}

// A labelled choice; `options` are value and words.
export function choice(label: string, id: string, options: [string, string][], chosen: string, change: (value: string) => void): HTMLElement {
  const select = h("select", { id, change: () => change(select.value) }, ...options.map(([value, words]) => h("option", { value }, words)));
  select.value = chosen;
  return h("label", { class: "choice", for: id }, h("span", {}, label), select);
}

export function checkbox(label: string, id: string, checked: boolean, change: (on: boolean) => void): HTMLElement {
  const box = h("input", { type: "checkbox", id, checked, change: () => change(box.checked) });
  return h("label", { class: "check", for: id }, box, h("span", {}, label));
}
