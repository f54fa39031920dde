// Pass times as stacked bars, a case each.
import * as Plot from "@observablehq/plot";
import { plotDefaults } from "../charts";
import { lookOf, passColours, swatch } from "../colours";
import { checkbox, h } from "../dom";
import { figure, withInterval, withUnit } from "../format";
import { readableChart } from "../reader";
import { table } from "../table";
import type { Column } from "../table";
import type { Page, View } from "../view";
import { chosenCases } from "./chosen";

const kMost = 40; // bars

interface Piece {
  row: number;
  pass: number;
  from: number; // on the axis: ms, or % of all passes
  to: number;
  ms: number;
  lo: number; // 95 % interval of the median
  hi: number;
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
      return { row, pass: of.pass[i], from, to: at, ms: of.ms[i], lo: of.ms[i] * (1 - of.below[i] / 1e4), hi: of.ms[i] * (1 + of.above[i] / 1e4) };
    });
  });
}

const kRow = 36; // px of a case: its name, and the bar below it
const kBar = { top: 17, bottom: 3 };

// A bar a case, and its sum; every piece tells its pass.
function bars(page: Page, cases: number[], shares: boolean): HTMLElement {
  const { report } = page;
  const colours = passColours(report);
  const rows = cases.map((_, i) => i);
  const all = pieces(page, cases, shares);
  const label = `Times of the passes of ${cases.length} cases, stacked; the table below has the figures`;
  const tell = (i: number) => {
    const d = all[i], c = cases[d.row];
    return [h("strong", {}, report.passes[d.pass]), h("br"), withInterval(d.ms, d.lo, d.hi, " ms"), h("br"),
            `${figure((100 * d.ms) / sumOf(page, c))} % of ${withUnit(sumOf(page, c), " ms")}, ${report.cases.label[c]}`];
  };
  return readableChart(label, (width) => {
    const plot = Plot.plot({
      ...plotDefaults(width, cases.length * kRow + 50),
      marginLeft: 8, marginTop: 22, marginBottom: 8, marginRight: 24,
      x: { axis: "top", grid: true, label: null, ticks: width < 560 ? 5 : 10 },
      y: { type: "band", domain: rows, axis: null, padding: 0 },
      color: { type: "identity" },
      marks: [
        Plot.barX(all, { y: "row", x1: "from", x2: "to", fill: (d: Piece) => colours[d.pass], insetTop: kBar.top, insetBottom: kBar.bottom, insetLeft: 0.5, insetRight: 0.5, className: "pieces" }),
        Plot.text(rows, { y: (r: number) => r, x: 0, text: (r: number) => `${withUnit(sumOf(page, cases[r]), " ms")}  ${report.cases.label[cases[r]]}`, textAnchor: "start", dy: -10, lineWidth: (width - 30) / 12, textOverflow: "ellipsis-end", fill: "currentColor", stroke: "var(--page)", strokeWidth: 3 }),
      ],
    });
    const sx = plot.scale("x")!, sy = plot.scale("y")!;
    const height = sy.bandwidth! - kBar.top - kBar.bottom;
    const spots = all.map((d) => {
      const from = sx.apply(d.from), to = sx.apply(d.to);
      return { x: (from + to) / 2, y: sy.apply(d.row) + kBar.top + height / 2, halfWidth: (to - from) / 2, halfHeight: height / 2 };
    });
    const marks = [...plot.querySelectorAll<SVGElement>("g.pieces rect")];
    const active = (i: number | null) => marks.forEach((m, k) => (m.style.opacity = i === null || all[i].row !== all[k].row || k === i ? "1" : "0.5"));
    return { plot, spots, tell, active };
  });
}

function passTable(page: Page, cases: number[], passes: number[], shares: boolean): HTMLElement {
  const { report, digest } = page;
  const msOf = (c: number, pass: number) => {
    const at = report.cases.passes[c].pass.indexOf(pass);
    return at < 0 ? null : report.cases.passes[c].ms[at];
  };
  const share = (c: number, pass: number) => (msOf(c, pass) === null ? null : (100 * msOf(c, pass)!) / sumOf(page, c));
  const cell = shares ? share : msOf;
  const columns: Column<number>[] = [
    { key: "case", title: "case", value: (c) => report.cases.label[c], node: (c) => swatch(lookOf(digest, report.methods[report.cases.method[c]])) },
    { key: "sum", title: "all passes", unit: "ms", value: (c) => sumOf(page, c), text: (c) => figure(sumOf(page, c)) },
    ...passes.map((p): Column<number> => ({ key: report.passes[p], title: report.passes[p], unit: shares ? "%" : "ms", value: (c) => cell(c, p), text: (c) => figure(cell(c, p)) })),
  ];
  return table({ caption: shares ? "Shares of the passes" : "Medians of the passes", file: `${report.name}-passes`, rows: cases, columns, state: page.state, prefix: "pa" });
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
      bars(page, drawn, shares),
      there.length > kMost ? h("p", { class: "note" }, `The ${kMost} fastest of ${there.length} cases are drawn; the table has all.`) : "",
      passTable(page, there, met, shares),
    );
  },
};
