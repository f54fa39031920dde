// The parts of a chart of the history: thin lines on a canvas, since there may be hundreds of hundreds of points;
// axes, and what is pointed at, in SVG above it.
import { swatch, type Look } from "../colours";
import type { Change, History } from "../data";
import { changePath, kindOf } from "./changes";
import { svg } from "../dom";
import { stretches, type Line } from "./history_model";
import { painter } from "./paint";
import { padded, scale, type Scale } from "./scale";

export interface PanelOptions {
  history: History;
  lines: Line[];
  changes: Change[]; // of these lines' series and the column
  title: string;
  id: string; // tells the page's charts apart
  height: number;
  from: number; // first and last report shown
  to: number;
  log: boolean;
  format: (value: number) => string; // of an axis
  look: (line: Line) => Look;
  marked: boolean; // changes on the lines themselves, too
  marker: number; // report that the only line is shown at when nothing is pointed at; -1: none
  describe: (line: Line, report: number) => HTMLElement; // what hovering shows
  pick: (line: Line, report: number) => void;
  zoom: (from: number, to: number) => void;
}

export const margin = { left: 58, right: 14, top: 10, bottom: 40 }, lane = 30; // px; the lane counts changes

export interface Frame {
  options: PanelOptions;
  width: number;
  x: (report: number) => number;
  y: Scale;
  bottom: number; // of the lines
}

export function frameOf(options: PanelOptions, width: number): Frame {
  const { lines, from, to, log, height } = options;
  const values = function* () {
    const ends = (l: Line) => (lines.length === 1 ? [l.y, l.lo, l.hi] : [l.y]);
    for (const l of lines) for (const end of ends(l)) for (let r = from; r <= to; ++r) if (end[r] !== null && (!log || end[r]! > 0)) yield end[r]!;
  };
  const [lo, hi] = padded(values(), log);
  const bottom = height - margin.bottom - lane;
  const room = width - margin.left - margin.right - 12;
  const x = (r: number) => margin.left + 6 + (to > from ? ((r - from) / (to - from)) * room : room / 2);
  return { options, width, x, y: scale(lo, hi, bottom, margin.top, log, Math.max(2, Math.round(bottom / 45))), bottom };
}

// Gaps stay gaps; a lone point is a dot.
export function drawLines(canvas: HTMLCanvasElement, f: Frame): void {
  const ratio = window.devicePixelRatio || 1, { lines, from, to, height } = f.options;
  canvas.width = f.width * ratio;
  canvas.height = height * ratio;
  const g = canvas.getContext("2d")!, paint = painter();
  g.scale(ratio, ratio);
  g.fillStyle = paint("var(--line)");
  for (const v of f.y.ticks) g.fillRect(margin.left, Math.round(f.y.at(v)), f.width - margin.left - margin.right, 1);
  g.lineWidth = lines.length > 40 ? 0.8 : 1.4;
  g.globalAlpha = Math.min(1, Math.max(0.25, 30 / lines.length));
  lines.forEach((line, place) => {
    g.strokeStyle = g.fillStyle = paint(f.options.look(line).colour);
    g.beginPath();
    for (let r = from; r <= to; ++r) {
      const v = line.y[r];
      if (v === null) continue;
      const x = f.x(r), y = f.y.at(v), joined = r > from && line.y[r - 1] !== null;
      if (joined) g.lineTo(x, y);
      else g.moveTo(x, y);
      if (!joined && (r === to || line.y[r + 1] === null)) g.fillRect(x - 1.5, y - 1.5, 3, 3);
    }
    g.stroke();
    if (lines.length <= 12) drawSymbols(g, f, line, place / lines.length);
  });
}

// For who can't tell the colours apart, and where two methods have one: some symbols on each line, not on one another.
function drawSymbols(g: CanvasRenderingContext2D, f: Frame, line: Line, shift: number): void {
  const { from, to } = f.options, every = Math.max(1, (to - from) / 5);
  const shape = new Path2D(swatch(f.options.look(line), 8).firstElementChild!.getAttribute("d") ?? "");
  for (let at = from + shift * every; at <= to; at += every) {
    const r = Math.round(at), v = line.y[r];
    if (v === null) continue;
    g.save();
    g.translate(f.x(r), f.y.at(v));
    g.fill(shape);
    g.restore();
  }
}

export function drawAxes(f: Frame): SVGElement {
  const { history, from, to, format } = f.options;
  const out = svg("g", { class: "axis" });
  const right = f.width - margin.right;
  for (const v of f.y.ticks) {
    const y = f.y.at(v);
    out.append(svg("text", { x: margin.left - 6, y: y + 4, "text-anchor": "end" }, format(v)));
  }
  const count = Math.max(1, Math.floor((right - margin.left) / 96)), every = Math.max(1, Math.ceil((to - from + 1) / count));
  for (let r = from; r <= to; r += every) {
    const at = f.x(r), base = f.options.height - margin.bottom;
    const { commit, created } = history.reports[r];
    const anchor = at > right - 30 ? "end" : "middle";
    out.append(svg("line", { x1: at, x2: at, y1: base, y2: base + 4, class: "tick" }),
               svg("text", { x: at, y: base + 17, "text-anchor": anchor }, created.slice(0, 10)),
               svg("text", { x: at, y: base + 31, "text-anchor": anchor, class: "commit" }, commit.slice(0, 7)));
  }
  return out;
}

// A report that was not compared: a rule through the lines and a cross on the axis.
export function drawRefusals(f: Frame): SVGElement {
  const out = svg("g", { class: "refusals" });
  const base = f.options.height - margin.bottom;
  for (let r = f.options.from; r <= f.options.to; ++r) {
    const { refusal, commit } = f.options.history.reports[r];
    if (refusal === "") continue;
    const x = f.x(r);
    out.append(svg("line", { x1: x, x2: x, y1: margin.top, y2: base, class: "refusal" }),
               svg("path", { d: `M${x - 4},${base - 4}l8,8m0,-8l-8,8`, class: "cross" },
                   svg("title", {}, `${commit.slice(0, 7)} was not compared: ${refusal}`)));
  }
  return out;
}

// How many series became worse (up) and better (down) in each report.
export function drawLane(f: Frame): SVGElement {
  const out = svg("g", { class: "lane" });
  const middle = f.bottom + lane / 2 + 2, most = lane / 2 - 3;
  const counts = new Map<number, { worse: number; better: number }>();
  for (const c of f.options.changes) {
    const kind = kindOf(c.change), at = counts.get(c.report) ?? { worse: 0, better: 0 };
    if (kind === "worse" || kind === "better") ++at[kind];
    counts.set(c.report, at);
  }
  const largest = Math.max(1, ...[...counts.values()].map((c) => Math.max(c.worse, c.better)));
  const width = Math.max(3, Math.min(10, f.x(f.options.from + 1) - f.x(f.options.from) - 1));
  out.append(svg("line", { x1: margin.left, x2: f.width - margin.right, y1: middle, y2: middle, class: "grid" }));
  for (const [report, c] of counts) {
    if (report < f.options.from || report > f.options.to) continue;
    const x = f.x(report) - width / 2;
    for (const kind of ["worse", "better"] as const) {
      if (c[kind] === 0) continue;
      const height = Math.max(4, (c[kind] / largest) * most);
      out.append(svg("rect", { x, width, y: kind === "worse" ? middle - height : middle, height, class: `change-${kind}` },
                     svg("title", {}, `${c[kind]} became ${kind}`)));
    }
  }
  return out;
}

export function drawMarks(f: Frame, line: Line, changes: Change[]): SVGElement {
  const out = svg("g", { class: "marks" });
  for (const c of changes) {
    const v = line.y[c.report];
    if (!line.series.includes(c.series) || v === null || c.report < f.options.from || c.report > f.options.to) continue;
    const kind = kindOf(c.change), lift = kind === "better" ? 11 : -11;
    const end = c.until === null ? null : line.y[c.until];
    if (end !== null && c.until! <= f.options.to)
      out.append(svg("line", { x1: f.x(c.report), y1: f.y.at(v) + lift, x2: f.x(c.until!), y2: f.y.at(end) + lift, class: `crept change-${kind}` }));
    out.append(svg("path", { d: changePath(c.change, 5), transform: `translate(${f.x(c.report)},${f.y.at(v) + lift})`,
                             class: `change-${kind}${c.persistent ? "" : " passing"}` }));
  }
  return out;
}

// The line that is pointed at: its intervals as a ribbon, the noise round its levels, and its changes.
export function drawFocus(f: Frame, line: Line, report: number): SVGElement {
  const out = svg("g", { class: "focus" });
  const { from, to } = f.options;
  const mine = line.series.length === 1 ? f.options.changes.filter((c) => c.series === line.series[0]) : [];
  if (line.noise !== null) {
    for (const s of stretches(line, mine)) {
      if (s.to < from || s.from > to) continue;
      const x = f.x(Math.max(s.from, from)) - 2, top = f.y.at(s.level * (1 + line.noise)), low = f.y.at(s.level / (1 + line.noise));
      out.append(svg("rect", { x, width: f.x(Math.min(s.to, to)) + 2 - x, y: top, height: Math.max(1, low - top), class: "noise" }));
    }
  }
  const upper: string[] = [], lower: string[] = [], path: string[] = [];
  for (let r = from; r <= to; ++r) {
    const v = line.y[r];
    if (v === null) continue;
    path.push(`${r > from && line.y[r - 1] !== null ? "L" : "M"}${f.x(r).toFixed(1)},${f.y.at(v).toFixed(1)}`);
    if (line.lo[r] === null || line.hi[r] === null) continue;
    upper.push(`${f.x(r).toFixed(1)},${f.y.at(line.hi[r]!).toFixed(1)}`);
    lower.unshift(`${f.x(r).toFixed(1)},${f.y.at(line.lo[r]!).toFixed(1)}`);
  }
  const colour = f.options.look(line).colour;
  if (upper.length > 0) out.append(svg("path", { d: `M${upper.join("L")}L${lower.join("L")}Z`, fill: colour, class: "ribbon" }));
  out.append(svg("path", { d: path.join(""), stroke: colour, class: "line" }), drawMarks(f, line, mine));
  const v = line.y[report];
  if (v !== null && v !== undefined && report >= from && report <= to) {
    const x = f.x(report);
    out.append(svg("line", { x1: x, x2: x, y1: margin.top, y2: f.options.height - margin.bottom, class: "hair" }));
    if (line.lo[report] !== null && line.hi[report] !== null)
      out.append(svg("line", { x1: x, x2: x, y1: f.y.at(line.lo[report]!), y2: f.y.at(line.hi[report]!), stroke: colour, class: "whisker" }));
    out.append(svg("circle", { cx: x, cy: f.y.at(v), r: 4, fill: colour }));
  }
  return out;
}

