// Pass times as stacked bars, a case each.
import * as Plot from "@observablehq/plot";
import { chart, plotDefaults } from "../charts";
import { lookOf, passColours, swatch } from "../colours";
import { checkbox, h } from "../dom";
import { figure, withUnit } from "../format";
import { table } from "../table";
import type { Column } from "../table";
import type { Page, View } from "../view";
import { chosenCases } from "./chosen";

const kMost = 40; // bars

interface Piece {
  row: number;
  pass: number;
  from: number;
  to: number;
  ms: number;
}

function sumOf({ report }: Page, c: number): number {
  return report.cases.passes[c].ms.reduce((s, v) => s + v, 0);
}

// In the frame's order, ms or shares of the frame.
function pieces(page: Page, cases: number[], shares: boolean): Piece[] {
  return cases.flatMap((c, row) => {
    const of = page.report.cases.passes[c];
    const scale = shares ? 100 / sumOf(page, c) : 1;
    const order = of.pass.map((_, i) => i).sort((a, b) => of.pass[a] - of.pass[b]);
    let at = 0;
    return order.map((i) => {
      const from = at;
      at += of.ms[i] * scale;
      return { row, pass: of.pass[i], from, to: at, ms: of.ms[i] };
    });
  });
}

function bars(page: Page, cases: number[], shares: boolean, width: number): Element {
  const { report } = page;
  const colours = passColours(report);
  const rows = cases.map((_, i) => i);
  const all = pieces(page, cases, shares);
  return Plot.plot({
    ...plotDefaults(width, cases.length * 36 + 50),
    marginLeft: 8, marginTop: 22, marginBottom: 8, marginRight: 24,
    x: { axis: "top", grid: true, label: null, ticks: width < 560 ? 5 : 10 },
    y: { type: "band", domain: rows, axis: null, padding: 0 },
    color: { type: "identity" },
    marks: [
      Plot.barX(all, { y: "row", x1: "from", x2: "to", fill: (d: Piece) => colours[d.pass], insetTop: 17, insetBottom: 3, insetLeft: 0.5, insetRight: 0.5, title: (d: Piece) => `${report.passes[d.pass]}: ${withUnit(d.ms, " ms")}` }),
      Plot.text(rows, { y: (r: number) => r, x: 0, text: (r: number) => `${withUnit(sumOf(page, cases[r]), " ms")}  ${report.cases.label[cases[r]]}`, textAnchor: "start", dy: -10, lineWidth: (width - 30) / 12, textOverflow: "ellipsis-end", fill: "currentColor", stroke: "var(--page)", strokeWidth: 3 }),
    ],
  });
}

function passTable(page: Page, cases: number[], passes: number[]): HTMLElement {
  const { report, digest } = page;
  const msOf = (c: number, pass: number) => {
    const at = report.cases.passes[c].pass.indexOf(pass);
    return at < 0 ? null : report.cases.passes[c].ms[at];
  };
  const columns: Column<number>[] = [
    { key: "case", title: "case", value: (c) => report.cases.label[c], node: (c) => swatch(lookOf(digest, report.methods[report.cases.method[c]])) },
    { key: "sum", title: "all passes", unit: "ms", value: (c) => sumOf(page, c), text: (c) => figure(sumOf(page, c)) },
    ...passes.map((p): Column<number> => ({ key: report.passes[p], title: report.passes[p], unit: "ms", value: (c) => msOf(c, p), text: (c) => figure(msOf(c, p)) })),
  ];
  return table({ caption: "Medians of the passes", file: `${report.name}-passes`, rows: cases, columns, state: page.state, prefix: "pa" });
}

export const passesView: View = {
  id: "passes",
  title: "Passes",
  has: ({ report }) => report.cases.passes.some((p) => p.pass.length > 0),
  draw(root, page) {
    const { report, state } = page;
    const { cases, control } = chosenCases(page, "pa.of");
    const there = cases.filter((c) => report.cases.passes[c].pass.length > 0).sort((a, b) => sumOf(page, a) - sumOf(page, b));
    const shares = state.get("pa.share") === "1";
    root.append(h("div", { class: "controls" }, h("h2", {}, shares ? "Passes, % of all" : "Passes, ms"), control, checkbox("as shares", "pa-share", shares, (on) => state.set({ "pa.share": on ? 1 : "" }))));
    if (there.length === 0) {
      root.append(h("p", {}, "No chosen case has times of passes. Select cases in another view, or choose the front."));
      return;
    }
    const drawn = there.slice(0, kMost);
    const met = [...new Set(there.flatMap((c) => report.cases.passes[c].pass))].sort((a, b) => a - b);
    const colours = passColours(report);
    root.append(
      h("ul", { class: "legend" }, ...met.map((p) => h("li", {}, h("span", { class: "dab", style: `background: ${colours[p]}` }), report.passes[p]))),
      chart(`Times of the passes of ${drawn.length} cases, stacked; the table below has the figures`, (width) => bars(page, drawn, shares, width)),
      there.length > kMost ? h("p", { class: "note" }, `The ${kMost} fastest of ${there.length} cases are drawn; the table has all.`) : "",
      passTable(page, there, met),
    );
  },
};
