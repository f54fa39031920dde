// Where a case's error comes from: a waterfall a case, one approximation after the other.
import * as Plot from "@observablehq/plot";
import { groupIndex, hiddenMethods, metricOf, selectedCases } from "../choice";
import { chart, plotDefaults } from "../charts";
import { lookOf, swatch } from "../colours";
import type { BudgetPart, Report } from "../data";
import { h } from "../dom";
import { figure, signed, withInterval, withUnit } from "../format";
import { table } from "../table";
import type { Page, View } from "../view";

type Budget = Report["budgets"][number];

// Of the chosen group and metric; of the selected cases alone where these have some.
function budgetsShown(page: Page): Budget[] {
  const { report } = page;
  const { cases } = report;
  const hidden = hiddenMethods(page), g = groupIndex(page), metric = metricOf(page).name;
  const all = report.budgets.filter((b) => b.metric === metric && cases.group[b.case] === g && !hidden.has(report.methods[cases.method[b.case]]));
  const chosen = new Set(selectedCases(page));
  const selected = all.filter((b) => chosen.has(b.case));
  return selected.length > 0 ? selected : all;
}

interface Bar {
  name: string;
  from: number;
  to: number;
  text: string;
}

// What was not run is in the next part that was; its name says so.
function barsOf(budget: Budget, unit: string): Bar[] {
  const bars: Bar[] = [];
  let from = 0, names: string[] = [];
  for (const part of budget.parts) {
    names.push(part.name);
    if (!part.error) continue;
    const to = part.error[0];
    bars.push({ name: names.join(" + "), from: part.increment === null ? 0 : from, to, text: part.increment === null || from === 0 ? withUnit(to, unit) : signed(part.increment, unit) });
    from = to;
    names = [];
  }
  return bars;
}

function waterfall(page: Page, budget: Budget, most: number, width: number): Element {
  const { report, digest } = page;
  const bars = barsOf(budget, metricOf(page).unit);
  const { colour } = lookOf(digest, report.methods[report.cases.method[budget.case]]);
  return Plot.plot({
    ...plotDefaults(width, bars.length * 34 + 30),
    marginLeft: 6, marginRight: 60, marginTop: 6, marginBottom: 24,
    x: { domain: [0, most], label: null, ticks: 5, grid: true },
    y: { type: "band", domain: bars.map((b) => b.name), axis: null, padding: 0 },
    color: { type: "identity" },
    marks: [
      Plot.barX(bars, { y: "name", x1: "from", x2: "to", fill: colour, fillOpacity: 0.85, insetTop: 16, insetBottom: 4 }),
      Plot.text(bars, { y: "name", text: "name", x: 0, textAnchor: "start", dx: 4, dy: -9, fill: "currentColor", stroke: "var(--page)", strokeWidth: 3 }),
      Plot.text(bars, { y: "name", x: (b: Bar) => Math.max(b.from, b.to), text: "text", textAnchor: "start", dx: 5, dy: 7, fill: "currentColor", stroke: "var(--page)", strokeWidth: 3 }),
      Plot.ruleX([0], { stroke: "var(--soft)" }),
    ],
  });
}

// "SG lobes of 3 cases: all-texels, shading vsgl16, visibility none": a line for each part and what it would take.
function missingOf(budgets: Budget[]): string[] {
  const counts = new Map<string, { part: BudgetPart; count: number }>();
  for (const part of budgets.flatMap((b) => b.parts).filter((p) => p.missing !== "")) {
    const key = `${part.name}: ${part.missing}`;
    counts.set(key, { part, count: (counts.get(key)?.count ?? 0) + 1 });
  }
  return [...counts.values()].map(({ part, count }) => `${part.name} of ${count === 1 ? "one case" : `${count} cases`}: ${part.missing}`);
}

interface Row {
  budget: Budget;
  part: BudgetPart;
}

export const budgetView: View = {
  id: "budget",
  title: "Error budget",
  filters: ["group", "metric", "methods"],
  has: ({ report }) => report.budgets.length > 0,
  draw(root, page) {
    const { report, digest } = page;
    const { label } = report.cases;
    const metric = metricOf(page);
    const budgets = budgetsShown(page);
    if (budgets.length === 0) {
      root.append(h("p", {}, "No case shown has a budget of this error in this scene."));
      return;
    }
    const most = Math.max(...budgets.flatMap((b) => b.parts.map((p) => p.error?.[0] ?? 0))) * 1.02;
    const swatchOf = (c: number) => swatch(lookOf(digest, report.methods[report.cases.method[c]]));
    const figures = budgets.map((b) => {
      const lost = b.flux_lost === null || Math.abs(b.flux_lost) < 5e-5 ? "" : `Flux ${b.flux_lost > 0 ? "lost" : "gained"}: ${figure(Math.abs(b.flux_lost) * 100)} %.`;
      const box = chart(`Error budget of ${label[b.case]}; the table below has the figures`, (width) => waterfall(page, b, most, width));
      box.prepend(h("h3", {}, swatchOf(b.case), label[b.case]));
      if (lost) box.append(h("figcaption", {}, lost));
      return box;
    });
    const missing = missingOf(budgets);
    const rows: Row[] = budgets.flatMap((budget) => budget.parts.map((part) => ({ budget, part })));
    root.append(
      h("p", { class: "note" }, `${metric.title}${metric.unit ? "," + metric.unit : ""}: what it is when one approximation joins those above it. Errors of metrics do not add up in general; an increment may be below 0.`),
      h("div", { class: "grid" }, ...figures),
      missing.length > 0 ? h("div", { class: "note" }, h("p", {}, "Not run, hence in the next part that was:"), h("ul", { class: "missing" }, ...missing.map((m) => h("li", {}, m)))) : "",
      table<Row>({
        caption: "Parts of the budgets", file: `${report.name}-budget`, rows, state: page.state, prefix: "budget",
        columns: [
          { key: "case", title: "case", value: (r) => label[r.budget.case], node: (r) => swatchOf(r.budget.case) },
          { key: "part", title: "part", value: (r) => r.part.name },
          { key: "error", title: metric.title, unit: metric.unit, value: (r) => r.part.error?.[0] ?? null, text: (r) => (r.part.error ? withInterval(...r.part.error, "") : "–") },
          { key: "increment", title: "increment", unit: metric.unit, value: (r) => r.part.increment, text: (r) => signed(r.part.increment, "") },
          { key: "from", title: "told by", value: (r) => (r.part.case >= 0 ? label[r.part.case] : r.part.missing ? "not run: " + r.part.missing : "") },
        ],
      }),
    );
  },
};
