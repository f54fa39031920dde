// The Pareto front of a group's cases, by the rules of `vsglbench analyze` (harness/answer/front.h, point.h): pure functions.

export interface Point {
  case: number; // index in Report.cases
  ms: number;
  msLo: number;
  msHi: number;
  error: number;
  errorLo: number;
  errorHi: number;
  seeds: number[]; // the error of each seed, in the report's order
  heavy: boolean; // error is the median, and the interval the range
}

// front: no other point has both less time and less error, by their estimates. dominated: a point of the front is
// better on one axis and better or the same on the other, beyond the intervals. ambiguous: the intervals can't tell.
export type Standing = "front" | "dominated" | "ambiguous";

export interface Placed {
  point: Point;
  standing: Standing;
  by: Point[]; // of the front, that dominate it, or could; by time
}

export type Relation = "better" | "worse" | "same" | "ambiguous";

export const kSmallestEffect = 0.005; // differences below this share are no result, whatever the noise

interface Columns {
  status: string[];
  times: Record<string, { value: (number | null)[]; lo: (number | null)[]; hi: (number | null)[] }>;
  errors: Record<string, { value: (number | null)[]; lo: (number | null)[]; hi: (number | null)[]; heavy: (0 | 1)[]; seeds: (number[] | null)[] }>;
}

// Cases without the time or the error have no point; by time.
export function pointsOf(cases: Columns, indices: number[], metric: string, time: string): Point[] {
  const t = cases.times[time], e = cases.errors[metric];
  if (!t || !e) return [];
  const points: Point[] = [];
  for (const c of indices) {
    const ms = t.value[c], error = e.value[c];
    if (cases.status[c] !== "ok" || ms === null || error === null || !(ms > 0)) continue;
    points.push({
      case: c,
      ms, msLo: t.lo[c] ?? ms, msHi: t.hi[c] ?? ms,
      error, errorLo: e.lo[c] ?? error, errorHi: e.hi[c] ?? error,
      seeds: e.seeds[c] ?? [], heavy: e.heavy[c] === 1,
    });
  }
  return points.sort((a, b) => a.ms - b.ms);
}

// The lower left staircase: by time, errors falling.
export function frontOf(points: Point[]): Point[] {
  const stairs: Point[] = [];
  let least = Infinity;
  for (const p of [...points].sort((a, b) => a.ms - b.ms || a.error - b.error)) {
    if (p.error >= least) continue;
    least = p.error;
    stairs.push(p);
  }
  return stairs;
}

// One entry a point, in their order. `noise`: of this time in this group, relative.
export function place(points: Point[], noise: number): Placed[] {
  const front = frontOf(points);
  const ahead = new Set(front);
  return points.map((point) => {
    if (ahead.has(point)) return { point, standing: "front", by: [] };
    const sure = front.filter((f) => dominates(f, point, noise));
    if (sure.length > 0) return { point, standing: "dominated", by: sure };
    return { point, standing: "ambiguous", by: front.filter((f) => f.ms <= point.ms && f.error <= point.error) };
  });
}

function dominates(a: Point, b: Point, noise: number): boolean {
  const cost = compareCosts(a, b, noise);
  if (cost !== "better" && cost !== "same") return false;
  const error = compareErrors(a, b);
  return error === "better" || (error === "same" && cost === "better");
}

// Seed by seed where both have the same: Student's interval of the mean log ratio, far narrower than the two intervals.
export function compareErrors(a: Point, b: Point, margin = kSmallestEffect): Relation {
  if (!sameSeeds(a, b)) return relation(ratioOf(a.errorLo, a.errorHi, b.errorLo, b.errorHi), margin);
  const [lo, hi] = meanInterval(a.seeds.map((v, i) => Math.log(v / b.seeds[i])));
  return relation([Math.exp(lo), Math.exp(hi)], margin);
}

export function compareCosts(a: Point, b: Point, noise: number): Relation {
  return relation(ratioOf(a.msLo, a.msHi, b.msLo, b.msHi), Math.max(noise, kSmallestEffect));
}

function relation([lo, hi]: [number, number], margin: number): Relation {
  const above = 1 + margin, below = 1 / above;
  if (hi < below) return "better";
  if (lo > above) return "worse";
  return lo >= below && hi <= above ? "same" : "ambiguous";
}

// The widest that the ratio of two numbers in these intervals can be.
function ratioOf(loA: number, hiA: number, loB: number, hiB: number): [number, number] {
  const least = 1e-300; // an error of 0, or an interval that reaches below it
  return [Math.max(loA, 0) / Math.max(hiB, least), Math.max(hiA, least) / Math.max(loB, least)];
}

function sameSeeds(a: Point, b: Point): boolean {
  return a.seeds.length >= 2 && a.seeds.length === b.seeds.length && a.seeds.every((v) => v > 0) && b.seeds.every((v) => v > 0);
}

// The mean's 95 % interval, of two samples or more.
export function meanInterval(samples: number[]): [number, number] {
  const n = samples.length;
  const mean = samples.reduce((sum, v) => sum + v, 0) / n;
  const square = samples.reduce((sum, v) => sum + (v - mean) ** 2, 0);
  const half = student95(n - 1) * Math.sqrt(square / (n - 1) / n);
  return [mean - half, mean + half];
}

const quantiles = new Map<number, number>();

// The 0.975 quantile of Student's distribution: [Abramowitz and Stegun 26.7.3, 26.7.4], halved until it is found.
export function student95(degrees: number): number {
  const there = quantiles.get(degrees);
  if (there !== undefined) return there;
  let lo = 0, hi = 13; // one degree has 12.7
  for (let k = 0; k < 60; ++k) {
    const middle = (lo + hi) / 2;
    if (within(middle, degrees) < 0.95) lo = middle;
    else hi = middle;
  }
  quantiles.set(degrees, hi);
  return hi;
}

// The probability of |T| < t.
function within(t: number, degrees: number): number {
  const theta = Math.atan(t / Math.sqrt(degrees)), cos = Math.cos(theta), sin = Math.sin(theta);
  const odd = degrees % 2 === 1;
  if (degrees === 1) return (2 * theta) / Math.PI;
  let term = odd ? cos : 1, sum = term;
  for (let k = odd ? 3 : 2; k < degrees; k += 2) {
    term *= (cos * cos * (k - 1)) / k;
    sum += term;
  }
  return odd ? (2 / Math.PI) * (theta + sin * sum) : sin * sum;
}
