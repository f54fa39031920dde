// The panel beside the chart: one point's settings, passes, figures, and its neighbours on the front.
import { settingsOf } from "../choice";
import { lookOf, passColours, swatch } from "../colours";
import { h } from "../dom";
import { bytes, figure, signed, withInterval, withUnit } from "../format";
import type { Placed } from "../pareto";
import type { FrontData } from "./front";

// "+0.8 ms buys −1.2 % SMAPE": from one point to another.
export function trade(data: FrontData, from: Placed, to: Placed): string {
  const ms = to.point.ms - from.point.ms, error = to.point.error - from.point.error;
  const what = `${signed(error, data.metric.unit)} ${data.metric.title}`;
  if (ms > 0) return error < 0 ? `${signed(ms, " ms")} buys ${what}` : `${signed(ms, " ms")} and ${what}`;
  return error > 0 ? `${signed(ms, " ms")} costs ${what}` : `${signed(ms, " ms")} and ${what}`;
}

function fact(name: string, value: string | Node): HTMLElement {
  return h("div", {}, h("dt", {}, name), h("dd", { class: "figure" }, value));
}

function named(data: FrontData, p: Placed): Node {
  const { report, digest } = data.page;
  const number = data.front.indexOf(p) + 1;
  return h("span", {}, swatch(lookOf(digest, report.methods[report.cases.method[p.point.case]])), (number > 0 ? `${number}: ` : "") + report.cases.label[p.point.case]);
}

// On the front: the steps to both sides. Behind it: what of the front is better.
function neighbours(data: FrontData, p: Placed): HTMLElement[] {
  const step = (words: string, to: Placed) => h("p", { class: "step" }, h("strong", {}, trade(data, p, to)), h("br"), `${words} `, named(data, to));
  if (p.standing === "front") {
    const at = data.front.indexOf(p);
    const next = data.front[at + 1], before = data.front[at - 1];
    return [
      next ? step("next on the front:", next) : h("p", { class: "soft" }, "No case shown has less error."),
      before ? step("before it:", before) : h("p", { class: "soft" }, "No case shown takes less time."),
    ];
  }
  const by = p.by.map((q) => data.byCase.get(q.case)!);
  const words = p.standing === "dominated" ? "dominated by" : "perhaps dominated by";
  const out = by.slice(0, 2).map((q) => step(words, q));
  if (by.length > 2) out.push(h("p", { class: "soft" }, `and by ${by.length - 2} more of the front`));
  return out;
}

const kPasses = 8;

function passes(data: FrontData, c: number): HTMLElement | null {
  const { report } = data.page;
  const of = report.cases.passes[c];
  if (!of || of.pass.length === 0) return null;
  const colours = passColours(report);
  const all = of.pass.map((p, i) => ({ name: report.passes[p], colour: colours[p], ms: of.ms[i] }));
  const sum = all.reduce((s, p) => s + p.ms, 0);
  const bar = h("div", { class: "bar", role: "img", "aria-label": "Shares of the passes" }, ...all.map((p) => h("span", { style: `flex-grow: ${p.ms / sum}; background: ${p.colour}`, title: `${p.name} ${withUnit(p.ms, " ms")}` })));
  const most = [...all].sort((a, b) => b.ms - a.ms);
  const rows: HTMLElement[] = most.slice(0, kPasses).map((p) => h("div", {}, h("dt", {}, h("span", { class: "dab", style: `background: ${p.colour}` }), p.name), h("dd", { class: "figure" }, withUnit(p.ms, " ms"))));
  const rest = most.slice(kPasses);
  if (rest.length > 0) rows.push(fact(`${rest.length} more`, withUnit(rest.reduce((s, p) => s + p.ms, 0), " ms")));
  return h("div", {}, h("h3", {}, "Passes"), bar, h("dl", { class: "list" }, ...rows));
}

// The first lines are those that a reader compares; the case's place is last.
export function details(data: FrontData, c: number | null): HTMLElement[] {
  const p = c === null ? undefined : data.byCase.get(c);
  if (c === null || !p) {
    return [
      h("p", { class: "soft" }, "Hover a point, or move with the arrow keys in the chart: its settings, passes and figures stand here, and what its neighbours on the front cost more and bring."),
      h("p", { class: "soft" }, "A click, or Enter, selects a case for the other views. Drag a rectangle to zoom, + and − zoom at the point; Escape resets."),
    ];
  }
  const { report, digest } = data.page;
  const point = p.point;
  const standing = { front: `point ${data.front.indexOf(p) + 1} of the front`, dominated: "dominated, beyond the intervals", ambiguous: "behind the front by the estimates; the intervals can't tell" }[p.standing];
  const seeds = point.seeds.length;
  const of = point.heavy ? `median and range of ${seeds} seeds, which are heavy-tailed` : seeds > 1 ? `mean of ${seeds} seeds` : "";
  const extra = report.extra.map((e) => [e.name.replace("_bytes", "").replaceAll("_", " "), report.cases.extra[e.name]?.[c], e.unit] as const).filter(([, v]) => v !== null && v !== undefined);
  const settings = settingsOf(report, c);
  return [
    h("h3", {}, swatch(lookOf(digest, report.methods[report.cases.method[c]])), report.cases.label[c]),
    h("p", { class: "soft" }, standing),
    h("dl", { class: "list" },
      fact(data.ms, withInterval(point.ms, point.msLo, point.msHi, " ms")),
      fact(data.metric.title, withInterval(point.error, point.errorLo, point.errorHi, data.metric.unit)),
    ),
    of ? h("p", { class: "soft" }, of) : h("span"),
    ...neighbours(data, p),
    passes(data, c) ?? h("span"),
    h("h3", {}, "Settings"),
    h("dl", { class: "list" },
      ...settings.map(([k, v]) => fact(k, v)),
      ...extra.map(([k, v, unit]) => fact(k, unit === "B" ? bytes(v) : figure(v, 4) + (unit ? " " + unit : ""))),
    ),
  ];
}
