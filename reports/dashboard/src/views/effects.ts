// The ledger of effects: what each scene calls for, what is skipped, why, and what it costs.
import type { Effect, Scene } from "../data";
import { h } from "../dom";
import { figure, signed } from "../format";
import { table, type Column } from "../table";
import type { Page, View } from "../view";
import { axisHead, axisRound, intervalMark, type Axis } from "./interval_mark";
import "./effects.css";
import "./marks.css";

const words = (name: string) => name.replaceAll("_", " ");
const needText = (e: Effect) => (e.needed ? "● needed" : "○ skipped");

// One axis for the whole page, so that prices of scenes can be compared by eye.
function priceAxis(scenes: Scene[]): Axis | null {
  const ends = scenes.flatMap((s) => s.effects).flatMap((e) => (e.ms === null ? [] : [e.ms, ...(e.ms_ci95 ?? [])]));
  if (ends.length === 0) return null;
  return { width: 220, ...axisRound(ends, 0, false, false), log: false, rule: 0, bound: null, format: (v) => figure(v) };
}

function priceText(e: Effect): string {
  if (e.ms === null) return "–";
  const interval = e.ms_ci95 ? ` [${figure(e.ms_ci95[0])} … ${figure(e.ms_ci95[1])}]` : "";
  return `${signed(e.ms, " ms")}${interval}`;
}

function priceMark(axis: Axis, e: Effect): Node {
  if (e.ms === null) return document.createTextNode("");
  const [lo, hi] = e.ms_ci95 ?? [e.ms, e.ms];
  return intervalMark(axis, { value: e.ms, lo, hi, noise: null, shape: "", kind: e.needed ? "plain" : "good", label: `${words(e.name)}: ${priceText(e)}` });
}

// What the frame costs beside the same with all effects.
function total(scene: Scene): HTMLElement | null {
  const p = scene.priced;
  if (!p) return null;
  const [lo, hi] = p.ratio_ci95;
  return h("p", {}, `With all effects a frame of ${p.case} takes ${figure(p.ratio)} [${figure(lo)} … ${figure(hi)}] times as long. `,
           h("span", { class: "soft" }, "What is needed is priced by leaving it out, what is skipped by adding it."));
}

function ledger(page: Page, scene: Scene, axis: Axis | null): HTMLElement {
  const needed = scene.effects.filter((e) => e.needed).length;
  const priced = axis !== null && scene.effects.some((e) => e.ms !== null);
  const columns: Column<Effect>[] = [
    { key: "name", title: "effect", value: (e) => words(e.name) },
    { key: "needed", title: "in the frame", value: (e) => (e.needed ? "needed" : "skipped"), text: needText },
  ];
  if (priced) columns.push(
    { key: "ms", title: "costs", unit: "ms", value: (e) => e.ms, text: (e) => signed(e.ms, ""), node: (e) => priceMark(axis, e), hint: "with its 95 % interval, on an axis that all scenes share" },
    { key: "lo", title: "from", unit: "ms", value: (e) => e.ms_ci95?.[0], text: (e) => figure(e.ms_ci95?.[0]), hint: "lower end of the 95 % interval" },
    { key: "hi", title: "to", unit: "ms", value: (e) => e.ms_ci95?.[1], text: (e) => figure(e.ms_ci95?.[1]), hint: "upper end of the 95 % interval" },
    { key: "bytes", title: "memory", unit: "MB", value: (e) => (e.bytes === null ? null : e.bytes / 1e6), text: (e) => (e.bytes === null ? "–" : figure(e.bytes / 1e6)) });
  columns.push({ key: "reason", title: "because", value: (e) => e.reason },
               { key: "passes", title: "passes", value: (e) => e.passes.join(" "), text: (e) => e.passes.join(", ") });
  const list = table({ caption: `${scene.name}: ${needed} of ${scene.effects.length} effects needed`, file: `vsglbench-effects-${scene.name}`,
                       rows: scene.effects, columns, state: page.state, prefix: `ef.${scene.name}` });
  list.classList.add("figures");
  if (priced) list.querySelector("thead th:nth-child(3) button")!.append(axisHead(axis));
  const sum = total(scene);
  if (sum) list.querySelector(".tablehead")!.after(sum);
  return list;
}

// Scenes beside each other: which effects each calls for.
function overview(scenes: Scene[]): HTMLElement {
  const names = [...new Set(scenes.flatMap((s) => s.effects.map((e) => e.name)))];
  const cell = (scene: Scene, name: string) => {
    const e = scene.effects.find((k) => k.name === name);
    return h("td", { class: e?.needed ? "needed" : "skipped", title: e ? e.reason : "not in this ledger" }, e ? (e.needed ? "● yes" : "○ no") : "–");
  };
  return h("section", { class: "table" }, h("div", { class: "tablehead" }, h("h3", {}, "What each scene calls for")),
    h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "What each scene calls for" }, h("table", { class: "effects-overview" },
      h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "effect"), ...scenes.map((s) => h("th", { scope: "col" }, s.name)))),
      h("tbody", {}, ...names.map((name) => h("tr", {}, h("th", { scope: "row" }, words(name)), ...scenes.map((s) => cell(s, name))))))));
}

export const effectsView: View = {
  id: "effects",
  title: "Effects",
  filters: [],
  has: ({ report }) => report.scenes.some((s) => s.effects.length > 0),
  draw(root, page) {
    const scenes = page.report.scenes.filter((s) => s.effects.length > 0);
    const axis = priceAxis(scenes);
    root.append(h("p", { class: "note" }, "An effect that a scene does not call for is skipped: the image is the same, the frame is cheaper."));
    if (!axis) root.append(h("p", { class: "note" }, "What effects cost was not measured in this report: `vsglbench run --price-effects=200` does."));
    if (scenes.length > 1) root.append(overview(scenes));
    for (const scene of scenes) root.append(ledger(page, scene, axis));
  },
};
