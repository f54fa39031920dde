// The filters that all views share: scene and visibility, metric, time, methods.
import { groupIndex, groupName, hiddenMethods, metricOf, metricsThere, timeOf, timesThere } from "./choice";
import { lookOf, swatch } from "./colours";
import { choice, h } from "./dom";
import { metricLabel } from "./format";
import type { Page, View } from "./view";

// Methods are the legend, too: a box each, with colour and symbol.
// What another view alone shows stays as it is.
function methodBoxes(page: Page, methods: string[]): HTMLElement {
  const { state, digest } = page;
  const hidden = hiddenMethods(page);
  const elsewhere = [...hidden].filter((m) => !methods.includes(m));
  const show = (these: string[]) => state.set({ x: [...elsewhere, ...methods.filter((m) => !these.includes(m))].join(",") });
  const shown = () => methods.filter((m) => !hidden.has(m));
  const boxes = methods.map((m) => {
    const id = "method-" + m;
    const toggle = () => show(hidden.has(m) ? [...shown(), m] : shown().filter((s) => s !== m));
    return h(
      "span", { class: "method" },
      h("label", { class: "check", for: id }, h("input", { type: "checkbox", id, checked: !hidden.has(m), change: toggle }), swatch(lookOf(digest, m)), h("span", {}, m)),
      h("button", { type: "button", class: "only", id: "only-" + m, "aria-label": `Only ${m}`, click: () => show([m]) }, "only"),
    );
  });
  return h("fieldset", { class: "methods" }, h("legend", {}, "Methods"), ...boxes, h("button", { type: "button", id: "all-methods", disabled: shown().length === methods.length, click: () => show(methods) }, "All"));
}

export function filters(page: Page, view?: View): HTMLElement[] {
  const { report, state } = page;
  const heeded = view?.filters ?? ["group", "metric", "time", "methods"];
  const methods = view?.methods?.(page) ?? report.methods;
  const out: HTMLElement[] = [];
  if (heeded.includes("group") && report.groups.length > 0) {
    const groups = report.groups.map((g, i): [string, string] => [String(i), groupName(report, g)]);
    out.push(choice("Scene", "group", groups, String(groupIndex(page)), (g) => state.set({ g: g === "0" ? "" : g })));
  }
  const metrics = metricsThere(report), times = timesThere(report);
  if (heeded.includes("metric") && metrics.length > 0) {
    out.push(choice("Error", "metric", metrics.map((m) => [m.name, metricLabel(m)]), metricOf(page).name, (m) => state.set({ m: m === metrics[0].name ? "" : m })));
  }
  if (heeded.includes("time") && times.length > 0) {
    out.push(choice("Time", "time", times.map((t) => [t.name, `${t.name}: ${t.words}`]), timeOf(page).name, (t) => state.set({ t: t === "method" ? "" : t })));
  }
  if (heeded.includes("methods") && methods.length > 1) out.push(methodBoxes(page, methods));
  return out;
}
