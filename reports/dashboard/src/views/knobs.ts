// What a knob costs: pairs of cases that differ in one setting alone.
import * as Plot from "@observablehq/plot";
import { groupIndex, groupName, hiddenMethods, metricOf } from "../choice";
import { logAxisX, logAxisY, logDomain, logScale, plotDefaults } from "../charts";
import { lookOf, swatch } from "../colours";
import type { Knob } from "../data";
import { choice, h } from "../dom";
import { change, figure, signed } from "../format";
import { readableChart } from "../reader";
import { table } from "../table";
import type { Page, View } from "../view";

interface Pair {
  knob: Knob;
  price: Knob["prices"][number];
  method: string;
  errorRatio: number | null; // after over before
  timeRatio: number | null; // of the method's time
}

function pairsOf(page: Page, knobs: Knob[]): Pair[] {
  const { report } = page;
  const { cases } = report;
  const hidden = hiddenMethods(page);
  const error = cases.errors[metricOf(page).name].value, ms = (cases.times.method ?? Object.values(cases.times)[0]).value;
  const ratio = (column: (number | null)[], p: Knob["prices"][number]) => {
    const before = column[p.before], after = column[p.after];
    return before && after && before > 0 && after > 0 ? after / before : null;
  };
  return knobs
    .flatMap((knob) => knob.prices.map((price) => ({ knob, price, method: report.methods[cases.method[price.before]], errorRatio: ratio(error, price), timeRatio: ratio(ms, price) })))
    .filter((p) => !hidden.has(p.method));
}

// Ratios of time and error: below 1 is better. A dot is a pair, a name the mean of a knob.
function ratioChart(page: Page, knobs: Knob[], pairs: Pair[]): HTMLElement {
  const { digest, report } = page;
  const drawn = pairs.filter((p) => p.errorRatio !== null && p.timeRatio !== null);
  const label = `Ratios of error and time of ${drawn.length} pairs of cases that differ in one setting; the tables below have the figures`;
  return readableChart(label, (width) => {
    const x = logDomain([...drawn.map((p) => p.timeRatio), ...knobs.map((k) => k.time_ratio), 1], 1.2);
    const y = logDomain([...drawn.map((p) => p.errorRatio), ...knobs.map((k) => k.error_ratio), 1], 1.2);
    const plot = Plot.plot({
      ...plotDefaults(width, Math.round(Math.min(460, Math.max(320, width * 0.5)))),
      x: logScale(x), y: logScale(y), symbol: { type: "identity" }, color: { type: "identity" },
      marks: [
        ...logAxisX(x, "time, after / before →", width < 560 ? 7 : 12), ...logAxisY(y, "↑ error, after / before"),
        Plot.frame({ stroke: "var(--line)" }), Plot.ruleX([1], { stroke: "var(--soft)" }), Plot.ruleY([1], { stroke: "var(--soft)" }),
        Plot.dot(drawn, { x: "timeRatio", y: "errorRatio", r: 3.5, fill: (p: Pair) => lookOf(digest, p.method).colour, symbol: (p: Pair) => lookOf(digest, p.method).symbol, fillOpacity: 0.8 }),
        Plot.dot(knobs, { x: "time_ratio", y: "error_ratio", r: 7, stroke: "var(--ink)", strokeWidth: 2 }),
        Plot.text(knobs, { x: "time_ratio", y: "error_ratio", text: "key", dx: 11, textAnchor: "start", fontWeight: 600, fill: "var(--ink)", stroke: "var(--page)", strokeWidth: 4 }),
      ],
    });
    const sx = plot.scale("x")!, sy = plot.scale("y")!;
    const spots = drawn.map((p) => ({ x: sx.apply(p.timeRatio), y: sy.apply(p.errorRatio) }));
    const tell = (i: number) => {
      const p = drawn[i];
      return [h("strong", {}, `${p.knob.key} from ${p.price.from} to ${p.price.to}`), h("br"), report.cases.label[p.price.before], h("br"), `time ${change(p.timeRatio)}, error ${change(p.errorRatio)}`];
    };
    return { plot, spots, tell };
  });
}

function knobTable(page: Page, knobs: Knob[]): HTMLElement {
  return table<Knob>({
    caption: "Knobs", file: `${page.report.name}-knobs`, rows: knobs, state: page.state, prefix: "kn.k",
    note: "Geometric means over all pairs of the scene, from one value of the setting to the next.",
    columns: [
      { key: "key", title: "setting", value: (k) => k.key },
      { key: "pairs", title: "pairs", value: (k) => k.pairs },
      { key: "error", title: "error", hint: "after over before", value: (k) => k.error_ratio, text: (k) => change(k.error_ratio) },
      { key: "time", title: "time", hint: "after over before", value: (k) => k.time_ratio, text: (k) => change(k.time_ratio) },
      { key: "pass", title: "pass that pays", hint: "whose median changes most, most often", value: (k) => k.pass },
    ],
  });
}

function pairTable(page: Page, pairs: Pair[]): HTMLElement {
  const { report, digest } = page;
  const unit = metricOf(page).unit;
  const bought = (p: Pair) => (p.price.ms === 0 ? null : -p.price.error / p.price.ms);
  return table<Pair>({
    caption: "Pairs", file: `${report.name}-pairs`, rows: pairs, state: page.state, prefix: "kn.p",
    columns: [
      { key: "before", title: "before", value: (p) => report.cases.label[p.price.before], node: (p) => swatch(lookOf(digest, p.method)) },
      { key: "key", title: "setting", value: (p) => p.knob.key },
      { key: "from", title: "from", value: (p) => p.price.from },
      { key: "to", title: "to", value: (p) => p.price.to },
      { key: "ms", title: "time", unit: "ms", value: (p) => p.price.ms, text: (p) => signed(p.price.ms, "") },
      { key: "error", title: "error", unit, value: (p) => p.price.error, text: (p) => signed(p.price.error, "") },
      { key: "bought", title: "error bought", unit: `${unit.trim()} / ms`.trim(), hint: "what a millisecond takes from the error", value: bought, text: (p) => figure(bought(p)) },
      { key: "pass", title: "pass that pays", value: (p) => p.price.pass },
      { key: "pass_ms", title: "of it", unit: "ms", value: (p) => p.price.pass_ms, text: (p) => signed(p.price.pass_ms, "") },
    ],
  });
}

export const knobsView: View = {
  id: "knobs",
  title: "Price per knob",
  filters: ["group", "metric", "methods"],
  has: ({ report }) => report.knobs.length > 0,
  draw(root, page) {
    const { report, state } = page;
    const g = groupIndex(page), metric = metricOf(page);
    const all = report.knobs.filter((k) => k.group === g && k.metric === metric.name);
    if (all.length === 0) {
      root.append(h("p", {}, "No two cases of this scene differ in one setting alone, or this error was not analysed."));
      return;
    }
    const key = state.get("kn.key");
    const knobs = all.some((k) => k.key === key) ? all.filter((k) => k.key === key) : all;
    const pairs = pairsOf(page, knobs);
    const options: [string, string][] = [["", "all"], ...all.map((k): [string, string] => [k.key, k.key])];
    root.append(
      h("div", { class: "controls" }, h("h2", {}, `${groupName(report, report.groups[g])}: what a setting costs and brings`), choice("Setting", "kn-key", options, knobs.length === all.length ? "" : key, (v) => state.set({ "kn.key": v }))),
      ratioChart(page, knobs, pairs),
      h("p", { class: "note" }, `A symbol is a pair of cases that differ in one setting alone, a ring the geometric mean of all pairs of a setting. Left of 1 is faster, below 1 is less ${metric.title}.`),
      knobTable(page, all),
      pairTable(page, pairs),
    );
  },
};
