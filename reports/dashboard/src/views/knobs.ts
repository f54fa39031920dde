// What a knob costs: pairs of cases that differ in one setting alone.
import * as Plot from "@observablehq/plot";
import { groupIndex, groupName, metricOf, timeOf } from "../choice";
import { logAxisX, logAxisY, logDomain, logScale, plotDefaults } from "../charts";
import { lookOf, swatch } from "../colours";
import { choice, h } from "../dom";
import { change, figure, signed } from "../format";
import { readableChart } from "../reader";
import { table } from "../table";
import type { Page, View } from "../view";
import { meansOf, pairsOf, type Mean, type Pair } from "./knobs_model";

// Ratios of time and error: below 1 is better. A dot is a pair, a name the mean of a knob.
function ratioChart(page: Page, means: Mean[], pairs: Pair[]): HTMLElement {
  const { digest, report } = page;
  const drawn = pairs.filter((p) => p.errorRatio !== null && p.timeRatio !== null);
  const rings = means.filter((m) => m.timeRatio !== null);
  const label = `Ratios of error and time of ${drawn.length} pairs of cases that differ in one setting; the tables below have the figures`;
  return readableChart(label, (width) => {
    const x = logDomain([...drawn.map((p) => p.timeRatio), ...rings.map((k) => k.timeRatio), 1], 1.2);
    const y = logDomain([...drawn.map((p) => p.errorRatio), ...rings.map((k) => k.errorRatio), 1], 1.2);
    const look = (p: Pair) => lookOf(digest, p.method);
    const height = Math.round(Math.min(460, Math.max(320, width * 0.5)));
    const name = ({ ring, ...place }: Name) => Plot.text([ring], { x: "timeRatio", y: "errorRatio", text: "key", ...place, fontWeight: 600, fill: "var(--ink)", stroke: "var(--page)", strokeWidth: 4, className: "name" });
    const plot = Plot.plot({
      ...plotDefaults(width, height),
      x: logScale(x), y: logScale(y), symbol: { type: "identity" }, color: { type: "identity" },
      marks: [
        ...logAxisX(x, `${timeOf(page).name} time, after / before →`, width < 560 ? 7 : 12), ...logAxisY(y, "↑ error, after / before"),
        Plot.frame({ stroke: "var(--line)" }), Plot.ruleX([1], { stroke: "var(--soft)" }), Plot.ruleY([1], { stroke: "var(--soft)" }),
        Plot.dot(drawn, { x: "timeRatio", y: "errorRatio", r: 3.5, fill: (p: Pair) => look(p).colour, symbol: (p: Pair) => look(p).symbol, fillOpacity: 0.8, className: "pairs" }),
        Plot.dot(rings, { x: "timeRatio", y: "errorRatio", r: 7, stroke: "var(--ink)", strokeWidth: 2, className: "means" }),
        ...namesOf(rings, x, y, width, height).map(name),
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

interface Name {
  ring: Mean;
  dx: number;
  dy: number;
  textAnchor: "start" | "middle" | "end";
}

// A name stands on the right of its ring, or where there is no room left, below, above; by hand, since Plot places no labels.
function namesOf(rings: Mean[], x: [number, number], y: [number, number], width: number, height: number): Name[] {
  const room = { x: width - 70, y: height - 68 }; // the frame, within the margins of plotDefaults
  const along = (v: number, [lo, hi]: [number, number], size: number) => (Math.log(v / lo) / Math.log(hi / lo)) * size;
  const taken: { left: number; right: number; y: number }[] = [];
  return rings.map((ring) => {
    const cx = along(ring.timeRatio!, x, room.x), cy = room.y - along(ring.errorRatio!, y, room.y), long = 8 * ring.key.length;
    const places: [Name, number][] = [
      [{ ring, dx: 11, dy: 0, textAnchor: "start" }, cx + 11], [{ ring, dx: -11, dy: 0, textAnchor: "end" }, cx - 11 - long],
      [{ ring, dx: 0, dy: 17, textAnchor: "middle" }, cx - long / 2], [{ ring, dx: 0, dy: -17, textAnchor: "middle" }, cx - long / 2],
    ];
    const box = ([name, left]: [Name, number]) => ({ left, right: left + long, y: cy + name.dy });
    const free = places.find((p) => {
      const b = box(p);
      return b.left > -10 && b.right < room.x + 10 && taken.every((t) => Math.abs(t.y - b.y) > 13 || t.right < b.left || t.left > b.right);
    });
    const chosen = free ?? places[0];
    taken.push(box(chosen));
    return chosen[0];
  });
}

function knobTable(page: Page, means: Mean[]): HTMLElement {
  return table<Mean>({
    caption: "Knobs", file: `${page.report.name}-knobs`, rows: means, state: page.state, prefix: "kn.k",
    note: "Geometric means over all pairs of the scene and the methods shown, from one value of the setting to the next.",
    columns: [
      { key: "key", title: "setting", value: (k) => k.key },
      { key: "pairs", title: "pairs", value: (k) => k.pairs },
      { key: "error", title: "error", hint: "after over before", value: (k) => k.errorRatio, text: (k) => change(k.errorRatio) },
      { key: "time", title: "time", hint: `${timeOf(page).words}: after over before`, value: (k) => k.timeRatio, text: (k) => change(k.timeRatio) },
      { key: "pass", title: "pass that pays", hint: "whose median changes most, most often", value: (k) => k.pass },
    ],
  });
}

function pairTable(page: Page, pairs: Pair[], left: number): HTMLElement {
  const { report, digest } = page;
  const unit = metricOf(page).unit;
  const bought = (p: Pair) => (p.ms === null || p.ms === 0 ? null : -p.price.error / p.ms);
  return table<Pair>({
    caption: "Pairs", file: `${report.name}-pairs`, rows: pairs, state: page.state, prefix: "kn.p",
    note: left > 0 ? `The page has the first pairs of each setting: ${left} more are in the means alone.` : undefined,
    columns: [
      { key: "before", title: "before", value: (p) => report.cases.label[p.price.before], node: (p) => swatch(lookOf(digest, p.method)) },
      { key: "key", title: "setting", value: (p) => p.knob.key },
      { key: "from", title: "from", value: (p) => p.price.from },
      { key: "to", title: "to", value: (p) => p.price.to },
      { key: "ms", title: "time", unit: "ms", hint: timeOf(page).words, value: (p) => p.ms, text: (p) => signed(p.ms, "") },
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
    const pairs = pairsOf(page, knobs), means = meansOf(page, knobs);
    const options: [string, string][] = [["", "all"], ...all.map((k): [string, string] => [k.key, k.key])];
    root.append(
      h("div", { class: "controls" }, h("h2", {}, `${groupName(report, report.groups[g])}: what a setting costs and brings`), choice("Setting", "kn-key", options, knobs.length === all.length ? "" : key, (v) => state.set({ "kn.key": v }))),
    );
    if (means.length === 0) {
      root.append(h("p", {}, "No two cases of the methods shown differ in one setting alone."));
      return;
    }
    const left = means.reduce((sum, m) => sum + m.pairs, 0) - pairs.filter((p) => p.errorRatio !== null).length;
    root.append(
      ratioChart(page, means, pairs),
      h("p", { class: "note" }, `A symbol is a pair of cases that differ in one setting alone, a ring the geometric mean of all pairs of a setting. Left of 1 is faster, below 1 is less ${metric.title}.`),
      knobTable(page, meansOf(page, all)),
      pairTable(page, pairs, left),
    );
  },
};
