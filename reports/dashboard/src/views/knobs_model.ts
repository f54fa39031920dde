// What a setting costs and brings: pairs of cases that differ in it alone, and their means.
import { hiddenMethods, metricOf, timeOf, timesOf } from "../choice";
import type { Knob } from "../data";
import type { Page } from "../view";

export interface Pair {
  knob: Knob;
  price: Knob["prices"][number];
  method: string;
  ms: number | null; // after less before, of the chosen time
  errorRatio: number | null; // after over before
  timeRatio: number | null;
}

// Pairs of the methods that are shown. Times are of the chosen sum.
export function pairsOf(page: Page, knobs: Knob[]): Pair[] {
  const { cases, methods } = page.report;
  const hidden = hiddenMethods(page);
  const error = cases.errors[metricOf(page).name].value, ms = timesOf(page).value;
  const ratio = (column: (number | null)[], p: Knob["prices"][number]) => {
    const before = column[p.before], after = column[p.after];
    return before && after && before > 0 && after > 0 ? after / before : null;
  };
  const more = (p: Knob["prices"][number]) => {
    const before = ms[p.before], after = ms[p.after];
    return before === null || after === null || before === undefined || after === undefined ? null : after - before;
  };
  return knobs
    .flatMap((knob) => knob.prices.map((price) => ({ knob, price, method: methods[cases.method[price.before]], ms: more(price), errorRatio: ratio(error, price), timeRatio: ratio(ms, price) })))
    .filter((p) => !hidden.has(p.method));
}

export interface Mean {
  knob: Knob;
  key: string;
  pairs: number;
  errorRatio: number; // geometric means over all pairs
  timeRatio: number | null; // null: a pair has no such time
  pass: string; // that pays most often; empty: none
}

// Over all pairs of the methods that are shown, whether or not the page has each of them. Without a pair: left out.
export function meansOf(page: Page, knobs: Knob[]): Mean[] {
  const hidden = hiddenMethods(page), time = timeOf(page).name;
  return knobs.flatMap((knob) => {
    const shown = knob.methods.filter((m) => !hidden.has(m.method));
    const pairs = shown.reduce((sum, m) => sum + m.pairs, 0);
    if (pairs === 0) return [];
    const error = shown.reduce((sum, m) => sum + m.error, 0);
    const timed = shown.every((m) => m.times[time] !== undefined);
    const logTime = shown.reduce((sum, m) => sum + (m.times[time] ?? 0), 0);
    return [{ knob, key: knob.key, pairs, errorRatio: Math.exp(error / pairs), timeRatio: timed ? Math.exp(logTime / pairs) : null, pass: payer(shown) }];
  });
}

// Of passes that pay equally often, the first by name.
function payer(shown: Knob["methods"]): string {
  const counts = new Map<string, number>();
  for (const m of shown) for (const [pass, n] of Object.entries(m.passes)) counts.set(pass, (counts.get(pass) ?? 0) + n);
  const names = [...counts.keys()].sort();
  return names.reduce((best, name) => (counts.get(name)! > counts.get(best)! ? name : best), names[0] ?? "");
}
