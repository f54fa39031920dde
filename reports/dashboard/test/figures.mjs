// Figures of a report.json as its reader would find them, without the page and without the programme's analysis.

export function casesOf(report, group) {
  return report.cases.filter((c) => c.scene === group.scene && c.accuracy?.reference.hash === group.reference);
}

export const median = (values) => {
  const sorted = [...values].sort((a, b) => a - b), half = sorted.length >> 1;
  return sorted.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
};

// Of samples where the report has them.
export const passMs = (pass) => (pass.samples_ms ? median(pass.samples_ms) : pass.median_ms);
export const sumOf = (c) => c.passes.reduce((sum, p) => sum + passMs(p), 0);

// Sums within each frame, then their median.
export const timeOf = (c, time) => (time === "frame" ? median(c.frame.span.samples_ms) : median(c.frame.method.samples_ms));

export function errorOf(c, metric) {
  const m = c.accuracy[metric];
  return m.heavy_tailed ? m.median : m.value;
}
export function intervalOf(c, metric) {
  const m = c.accuracy[metric];
  return m.heavy_tailed ? [m.least, m.largest] : m.ci95;
}

// No other case has both less time and less error; by time.
export function frontOf(cases, metric = "smape", time = "method") {
  const points = cases.map((c) => ({ c, ms: timeOf(c, time), error: errorOf(c, metric) }));
  const beats = (a, b) => a.ms <= b.ms && a.error <= b.error && (a.ms < b.ms || a.error < b.error);
  return points.filter((p) => !points.some((q) => beats(q, p))).sort((a, b) => a.ms - b.ms).map((p) => p.c);
}

// Cases that differ in one setting alone: lists by all else. A case without the setting is in none.
export function series(cases, key) {
  const rest = (c) => JSON.stringify([c.method, Object.entries(c.parameters).filter(([k]) => k !== key).sort()]);
  const out = new Map();
  for (const c of cases) {
    if (c.parameters[key] === undefined) continue;
    if (!out.has(rest(c))) out.set(rest(c), []);
    out.get(rest(c)).push(c);
  }
  return [...out.values()].filter((list) => list.length >= 2);
}

// From one number to the next; of words each against the first.
export function pairs(cases, key) {
  return series(cases, key).flatMap((list) => {
    const numbers = typeof list[0].parameters[key] === "number";
    const sorted = numbers ? [...list].sort((a, b) => a.parameters[key] - b.parameters[key]) : list;
    return sorted.slice(1).map((after, i) => ({ before: sorted[numbers ? i : 0], after }));
  });
}

export const geometricMean = (ratios) => Math.exp(ratios.reduce((sum, r) => sum + Math.log(r), 0) / ratios.length);

// Whether the first has, in any order, the rows of the second: by the numbers that `of` and `wanted` give.
export function sameRows(rows, of, expected, wanted, tolerance = 1e-5) {
  const left = expected.map(wanted);
  for (const row of rows) {
    const numbers = of(row);
    const at = left.findIndex((w) => w.every((v, i) => (typeof v === "number" ? Math.abs(numbers[i] - v) <= tolerance * Math.abs(v) + 1e-9 : numbers[i] === v)));
    if (at < 0) return `no such row is expected: ${JSON.stringify(numbers)}`;
    left.splice(at, 1);
  }
  return left.length === 0 ? "" : `${left.length} rows are missing, ${JSON.stringify(left[0])} the first`;
}
