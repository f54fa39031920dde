// Where a number stands on an axis, and which numbers are written beside it.
export interface Scale {
  at(value: number): number; // in px
  ticks: number[];
}

export function scale(lo: number, hi: number, from: number, to: number, log: boolean, count: number): Scale {
  const f = log ? Math.log : (v: number) => v;
  const a = f(lo), b = f(hi);
  const at = (v: number) => from + ((f(v) - a) / (b - a || 1)) * (to - from);
  return { at, ticks: log && hi / lo > 8 ? decades(lo, hi, count) : steps(lo, hi, count) };
}

// Multiples of 1, 2 or 5 times a power of ten, about `count` of them.
function steps(lo: number, hi: number, count: number): number[] {
  const rough = (hi - lo) / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough) ?? rough;
  const out: number[] = [];
  for (let i = Math.ceil(lo / step - 1e-9); i * step <= hi * (1 + 1e-12) && out.length < 100; ++i) out.push(Number((i * step).toPrecision(12)));
  return out;
}

// 1, 2 and 5 times powers of ten; of many decades the powers alone, or every second, third, ... of them.
function decades(lo: number, hi: number, count: number): number[] {
  const first = Math.floor(Math.log10(lo)), last = Math.ceil(Math.log10(hi));
  const every = Math.max(1, Math.ceil((last - first) / Math.max(1, count)));
  const mantissas = 3 * (last - first) <= count + 3 ? [1, 2, 5] : [1];
  const out: number[] = [];
  for (let e = first; e <= last; e += every)
    for (const m of mantissas) out.push(Number(`${m}e${e}`));
  return out.filter((v) => v >= lo && v <= hi);
}

// The range of the numbers, widened by a part of itself at both ends so that no line lies on the frame.
export function padded(values: Iterable<number>, log: boolean): [number, number] {
  let lo = Infinity, hi = -Infinity;
  for (const v of values) {
    if (v < lo) lo = v;
    if (v > hi) hi = v;
  }
  if (!(lo <= hi)) return log ? [0.5, 2] : [0, 1];
  if (log) {
    const by = Math.max(1.01, (hi / lo) ** 0.05);
    return [lo / by, hi * by];
  }
  const by = 0.05 * (hi - lo) || 0.01 * Math.abs(hi) || 1;
  return [lo - by, hi + by];
}
