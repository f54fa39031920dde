// A figure with its 95 % interval on a small axis, for a row of a table; and the axis itself for its head.
import { changePath } from "./changes";
import { svg } from "../dom";
import { scale } from "./scale";

export interface Axis {
  width: number; // px
  lo: number;
  hi: number;
  log: boolean;
  rule: number; // where "no difference" stands
  bound: { side: "below" | "above"; value: number } | null; // what a claim promises: shaded
  format: (value: number) => string;
}

export interface Mark {
  value: number;
  lo: number;
  hi: number;
  noise: number | null; // relative, round the rule
  shape: string; // a change, see changePath(); "": a dot
  kind: string; // class of the colour
  label: string; // for who doesn't see it
}

const edge = 6; // px at both ends, for half a symbol

const scaleOf = (a: Axis) => scale(a.lo, a.hi, edge, a.width - edge, a.log, Math.max(2, Math.round(a.width / 60)));
const inside = (a: Axis, v: number) => Math.min(a.hi, Math.max(a.lo, v));

export function intervalMark(a: Axis, m: Mark): SVGElement {
  const height = 18, middle = height / 2, x = scaleOf(a);
  const at = (v: number) => x.at(inside(a, v));
  const out = svg("svg", { width: a.width, height, viewBox: `0 0 ${a.width} ${height}`, role: "img", "aria-label": m.label, class: `interval mark-${m.kind}` });
  if (a.bound) {
    const [from, to] = a.bound.side === "below" ? [0, at(a.bound.value)] : [at(a.bound.value), a.width];
    out.append(svg("rect", { x: from, width: Math.max(0, to - from), y: 0, height, class: "promised" }));
  }
  if (m.noise !== null && m.noise > 0) {
    const from = at(a.rule / (1 + m.noise)), to = at(a.rule * (1 + m.noise));
    out.append(svg("rect", { x: from, width: Math.max(1, to - from), y: 0, height, class: "noise" }));
  }
  out.append(svg("line", { x1: at(a.rule), x2: at(a.rule), y1: 0, y2: height, class: "rule" }));
  if (a.bound && a.bound.value !== a.rule)
    out.append(svg("line", { x1: at(a.bound.value), x2: at(a.bound.value), y1: 0, y2: height, class: "bound" }));
  out.append(svg("line", { x1: at(m.lo), x2: at(m.hi), y1: middle, y2: middle, class: "whisker" }));
  // An arrow says that an end lies beyond the axis.
  if (m.lo < a.lo) out.append(svg("path", { d: `M1,${middle}l6,-4v8Z`, class: "beyond" }));
  if (m.hi > a.hi) out.append(svg("path", { d: `M${a.width - 1},${middle}l-6,-4v8Z`, class: "beyond" }));
  out.append(svg("path", { d: changePath(m.shape || "same", m.shape ? 4.5 : 3.5), transform: `translate(${at(m.value)},${middle})`, class: "point" }));
  return out;
}

export function axisHead(a: Axis): SVGElement {
  const height = 20, x = scaleOf(a);
  const out = svg("svg", { width: a.width, height, viewBox: `0 0 ${a.width} ${height}`, class: "axis", "aria-hidden": "true" });
  let last = -Infinity;
  for (const v of x.ticks) {
    const text = a.format(v), at = x.at(v), half = text.length * 3.4;
    const anchor = at - half < 0 ? "start" : at + half > a.width ? "end" : "middle";
    const left = anchor === "start" ? at : anchor === "end" ? at - 2 * half : at - half;
    out.append(svg("line", { x1: at, x2: at, y1: height - 4, y2: height, class: "tick" }));
    if (left < last + 6) continue; // no room for its words
    last = left + 2 * half;
    out.append(svg("text", { x: at, y: height - 7, "text-anchor": anchor }, text));
  }
  return out;
}

// An axis that holds all that is given, and the rule; of ratios as far on both sides of it.
export function axisRound(values: number[], rule: number, log: boolean, symmetric: boolean): { lo: number; hi: number } {
  const f = log ? Math.log : (v: number) => v, back = log ? Math.exp : (v: number) => v;
  const there = [...values, rule].filter((v) => Number.isFinite(v) && (!log || v > 0)).map(f);
  const lo = Math.min(...there), hi = Math.max(...there), middle = f(rule);
  const reach = Math.max(hi - middle, middle - lo, log ? 0.005 : 1e-6) * 1.06;
  if (symmetric) return { lo: back(middle - reach), hi: back(middle + reach) };
  const pad = 0.04 * Math.max(hi - lo, log ? 0.1 : 1e-6);
  return { lo: back(lo - pad), hi: back(hi + pad) };
}
