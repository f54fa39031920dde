// What the history view draws: a line over reports for each series, or for the mean of each method.
import type { Change, History } from "../data";

export type Base = "absolute" | "first" | "median"; // what figures are divided by

export interface Line {
  key: string; // "s12": series 12; "m3/mfis": mean of a method in a scene
  label: string;
  scene: string;
  method: string;
  series: number[]; // indices in History.series that it is made of
  y: (number | null)[]; // one entry a report
  lo: (number | null)[]; // ends of the 95 % interval; of a mean: none
  hi: (number | null)[];
  divisor: number; // y times this is the figure in the column's unit
  noise: number | null; // A/A floor, relative
}

const positive = (v: number | null): v is number => v !== null && v > 0;

function median(values: number[]): number {
  const sorted = [...values].sort((a, b) => a - b);
  const half = sorted.length >> 1;
  return sorted.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

function divisorOf(values: (number | null)[], base: Base): number {
  if (base === "absolute") return 1;
  const there = values.filter(positive);
  if (there.length === 0) return 1;
  return base === "first" ? there[0] : median(there);
}

export function seriesLine(history: History, index: number, column: string, base: Base): Line | null {
  const s = history.series[index];
  const figures = s.values[column];
  if (!figures || !figures.value.some((v) => v !== null)) return null;
  const divisor = divisorOf(figures.value, base);
  const over = (v: number | null) => (v === null ? null : v / divisor);
  return {
    key: `s${index}`,
    label: s.label,
    scene: s.scene,
    method: s.method,
    series: [index],
    y: figures.value.map(over),
    lo: figures.lo.map(over),
    hi: figures.hi.map(over),
    divisor,
    noise: s.noise[column] ?? null,
  };
}

// The geometric mean of many series. A series that begins late or has gaps must make no step, so the mean is
// chained: from one report to the next it changes as those do that have a figure in both, or had one before.
export function meanLine(history: History, indices: number[], column: string, base: Base): Line | null {
  const all = indices.map((i) => history.series[i].values[column]?.value).filter((v) => v !== undefined);
  const firsts = all.map((v) => v.find(positive)).filter((v) => v !== undefined);
  if (firsts.length === 0) return null;
  let level = firsts.reduce((sum, v) => sum + Math.log(v), 0) / firsts.length;
  const last: (number | null)[] = all.map(() => null);
  const y: (number | null)[] = history.reports.map((_, report) => {
    let sum = 0, count = 0, there = false;
    all.forEach((values, i) => {
      const v = values[report];
      if (!positive(v)) return;
      there = true;
      const before = last[i];
      if (before !== null) {
        sum += Math.log(v / before);
        ++count;
      }
      last[i] = v;
    });
    if (count > 0) level += sum / count;
    return there ? Math.exp(level) : null;
  });
  const divisor = divisorOf(y, base);
  const { scene, method } = history.series[indices[0]];
  const none = y.map(() => null);
  return { key: `m${scene}/${method}`, label: `${method}, mean of ${all.length}`, scene, method, series: indices,
           y: y.map((v) => (v === null ? null : v / divisor)), lo: none, hi: none, divisor, noise: null };
}

// Those of the filter, in the order of the history.
export function chosen(history: History, scene: string, hidden: Set<string>, text: string): number[] {
  const words = text.toLowerCase().split(/\s+/).filter((w) => w !== "");
  const out: number[] = [];
  history.series.forEach((s, i) => {
    if (scene !== "" && s.scene !== scene) return;
    if (hidden.has(s.method)) return;
    const name = `${s.id} ${s.label}`.toLowerCase();
    if (words.every((w) => name.includes(w))) out.push(i);
  });
  return out;
}

export function linesOf(history: History, indices: number[], column: string, base: Base, means: boolean): Line[] {
  if (!means) return indices.map((i) => seriesLine(history, i, column, base)).filter((l) => l !== null);
  const groups = new Map<string, number[]>();
  for (const i of indices) {
    const key = `${history.series[i].scene}/${history.series[i].method}`;
    groups.set(key, [...(groups.get(key) ?? []), i]);
  }
  return [...groups.values()].map((g) => meanLine(history, g, column, base)).filter((l) => l !== null);
}

// The median of a line between the reports where it changed: noise goes round this.
export interface Stretch {
  from: number;
  to: number; // the last report of it
  level: number;
}

export function stretches(line: Line, changes: Change[]): Stretch[] {
  const starts = [...new Set([0, ...changes.map((c) => c.report)])].sort((a, b) => a - b);
  const out: Stretch[] = [];
  starts.forEach((from, i) => {
    const to = (starts[i + 1] ?? line.y.length) - 1;
    const there = line.y.slice(from, to + 1).filter(positive);
    if (there.length > 0) out.push({ from, to, level: median(there) });
  });
  return out;
}

// The figure of the nearest earlier report that has one.
export function before(line: Line, report: number): number | null {
  for (let r = report - 1; r >= 0; --r) if (line.y[r] !== null) return line.y[r];
  return null;
}

// Of the series behind a mean, the one that changed most from the report before.
export function mover(history: History, line: Line, column: string, report: number): { label: string; ratio: number } | null {
  let best: { label: string; ratio: number } | null = null;
  for (const i of line.series) {
    const values = history.series[i].values[column]?.value;
    const now = values?.[report], then = values?.[report - 1];
    if (now == null || then == null || !(now > 0 && then > 0)) continue;
    const ratio = now / then;
    if (!best || Math.abs(Math.log(ratio)) > Math.abs(Math.log(best.ratio))) best = { label: history.series[i].label, ratio };
  }
  return best;
}
