// Error, or time, over a numeric setting: a curve for each method and choice of all else.
import * as Plot from "@observablehq/plot";
import { casesShown, errorsOf, groupName, groupOf, metricOf, methodOf, settingsOf, timeOf, timesOf } from "../choice";
import { logAxisX, logAxisY, logDomain, logScale, plotDefaults } from "../charts";
import { lookOf, swatch } from "../colours";
import { choice, h } from "../dom";
import { figure, withInterval, withUnit } from "../format";
import { readableChart } from "../reader";
import { table } from "../table";
import type { Page, View } from "../view";

interface Sample {
  case: number;
  key: number;
  value: number;
  lo: number;
  hi: number;
}

interface Curve {
  method: string;
  rest: string; // all other settings that differ in the report
  samples: Sample[]; // by key
}

// Settings that are numbers above 0, of which some method has two or more.
function numericKeys(page: Page): string[] {
  const { cases, settings } = page.report;
  const shown = casesShown(page);
  const counts = Object.entries(cases.parameters).filter(([key]) => !(key in settings)).map(([key, column]) => {
    const values = shown.map((c) => column[c]).filter((v) => v !== null);
    return { key, all: values.every((v) => typeof v === "number" && v > 0), count: new Set(values).size };
  });
  const keys = counts.filter((k) => k.all && k.count >= 2).map((k) => k.key);
  return keys.sort((a, b) => Number(b === "N") - Number(a === "N"));
}

function curvesOf(page: Page, key: string, of: "error" | "time"): Curve[] {
  const { report } = page;
  const column = of === "error" ? errorsOf(page) : timesOf(page);
  const curves = new Map<string, Curve>();
  for (const c of casesShown(page)) {
    const at = report.cases.parameters[key][c], value = column.value[c];
    if (typeof at !== "number" || value === null || !(value > 0) || report.cases.status[c] !== "ok") continue;
    const method = methodOf(report, c);
    const rest = settingsOf(report, c).filter(([k]) => k !== key).map(([k, v]) => `${k}=${v}`).join(", ");
    const name = `${method} ${rest}`;
    if (!curves.has(name)) curves.set(name, { method, rest, samples: [] });
    curves.get(name)!.samples.push({ case: c, key: at, value, lo: column.lo[c] ?? value, hi: column.hi[c] ?? value });
  }
  const out = [...curves.values()].filter((c) => c.samples.length >= 2);
  out.forEach((c) => c.samples.sort((a, b) => a.key - b.key));
  return out;
}

function curveChart(page: Page, key: string, words: string, unit: string, curves: Curve[]): HTMLElement {
  const { digest, report } = page;
  const rows = curves.flatMap((curve, i) => curve.samples.map((s) => ({ ...s, curve, i })));
  type Row = (typeof rows)[number];
  const label = `${words} over ${key}, ${curves.length} curves; the table below has the figures`;
  return readableChart(label, (width) => {
    const x = logDomain(rows.map((r) => r.key), 1.15), y = logDomain(rows.flatMap((r) => [r.value, r.hi, Math.max(r.lo, r.value / 3)]));
    const look = (r: Row) => lookOf(digest, r.curve.method);
    const keys = [...new Set(rows.map((r) => r.key))];
    const axisX = keys.length <= 12 ? [Plot.gridX(keys), Plot.axisX(keys, { label: `${key} →`, text: String })] : logAxisX(x, `${key} →`);
    const plot = Plot.plot({
      ...plotDefaults(width, Math.round(Math.min(520, Math.max(330, width * 0.5)))),
      x: logScale(x), y: logScale(y), symbol: { type: "identity" }, color: { type: "identity" },
      marks: [
        ...axisX, ...logAxisY(y, `↑ ${words}${unit ? "," + unit : ""}`), Plot.frame({ stroke: "var(--line)" }),
        Plot.ruleX(rows, { x: "key", y1: (r: Row) => Math.max(r.lo, y[0]), y2: "hi", stroke: (r: Row) => look(r).colour, strokeOpacity: 0.45 }),
        Plot.line(rows, { x: "key", y: "value", z: "i", stroke: (r: Row) => look(r).colour, strokeWidth: 1.5, className: "curves" }),
        Plot.dot(rows, { x: "key", y: "value", r: 4, fill: (r: Row) => look(r).colour, symbol: (r: Row) => look(r).symbol }),
      ],
    });
    const sx = plot.scale("x")!, sy = plot.scale("y")!;
    const paths = [...plot.querySelectorAll<SVGElement>("g.curves path, .curves path")];
    const spots = rows.map((r) => ({ x: sx.apply(r.key), y: sy.apply(r.value) }));
    const tell = (i: number) => {
      const r = rows[i];
      return [h("strong", {}, report.cases.label[r.case]), h("br"), `${key} = ${r.key}: ${withInterval(r.value, r.lo, r.hi, unit)}`, h("br"), r.curve.rest];
    };
    const active = (i: number | null) => paths.forEach((p, k) => (p.style.opacity = i === null || rows[i].i === k ? "1" : "0.15"));
    return { plot, spots, tell, active };
  });
}

export const convergenceView: View = {
  id: "convergence",
  title: "Convergence",
  has: (page) => page.report.groups.length > 0 && Object.entries(page.report.cases.parameters).some(([key, v]) => !(key in page.report.settings) && new Set(v.filter((x) => typeof x === "number" && x > 0)).size >= 2),
  draw(root, page) {
    const { report, digest, state } = page;
    const metric = metricOf(page), time = timeOf(page);
    const keys = numericKeys(page);
    const key = keys.includes(state.get("co.key")) ? state.get("co.key") : keys[0];
    const of = state.get("co.of") === "time" ? "time" : "error";
    const curves = key === undefined ? [] : curvesOf(page, key, of);
    const words = of === "error" ? metric.title : `${time.name} time`, unit = of === "error" ? metric.unit : " ms";
    root.append(
      h("div", { class: "controls" },
        h("h2", {}, groupName(report, groupOf(page)!)),
        choice("Shown", "co-of", [["error", metric.title], ["time", `${time.name} time`]], of, (v) => state.set({ "co.of": v === "error" ? "" : v })),
        keys.length > 0 ? choice("over", "co-key", keys.map((k) => [k, k]), key, (v) => state.set({ "co.key": v === keys[0] ? "" : v })) : null,
      ),
    );
    if (curves.length === 0) {
      root.append(h("p", {}, "No two cases that are shown differ in this setting alone."));
      return;
    }
    const rows = curves.flatMap((curve) => curve.samples.map((s, i) => ({ ...s, curve, before: curve.samples[i - 1] })));
    type Row = (typeof rows)[number];
    // the exponent p of value ∝ key^p, from the sample before
    const order = (r: Row) => (r.before ? Math.log(r.value / r.before.value) / Math.log(r.key / r.before.key) : null);
    root.append(
      curveChart(page, key, words, unit, curves),
      h("p", { class: "note" }, `${curves.length} curves: a method with a choice of all other settings each. Bars are 95 % intervals.`),
      table<Row>({
        caption: `${words} over ${key}`, file: `${report.name}-convergence`, rows, state, prefix: "co",
        columns: [
          { key: "method", title: "method", value: (r) => r.curve.method, node: (r) => swatch(lookOf(digest, r.curve.method)) },
          { key: "key", title: key, value: (r) => r.key },
          { key: "value", title: words, unit, value: (r) => r.value, text: (r) => withInterval(r.value, r.lo, r.hi, "") },
          { key: "before", title: "before", hint: "value of the sample before on its curve", unit, value: (r) => r.before?.value ?? null, text: (r) => withUnit(r.before?.value, "") },
          { key: "order", title: "order", hint: "p of value ∝ setting^p, from the sample before", value: order, text: (r) => figure(order(r), 2) },
          { key: "rest", title: "other settings", value: (r) => r.curve.rest },
        ],
      }),
    );
  },
};
