// Flicker of each case with its interval, and over the frames.
import * as Plot from "@observablehq/plot";
import { methodOf } from "../choice";
import { lookOf } from "../colours";
import { chart, plotDefaults } from "../charts";
import type { Flicker, Temporal } from "../data";
import { figure } from "../format";
import type { Page } from "../view";

export type Measure = "derivative" | "static";

interface Dot {
  label: string;
  measure: Measure;
  flicker: Flicker;
  colour: string;
  symbol: Plot.SymbolType;
}
interface Step {
  label: string;
  at: number;
  value: number;
  worst: boolean;
  colour: string;
  symbol: Plot.SymbolType;
  key: number;
}

// "mfis K=1" twice would be one row: then the case's id stands for it.
export function namesOf({ report }: Page, all: Temporal[]): Map<Temporal, string> {
  const labels = all.map((t) => report.cases.label[t.case]);
  return new Map(all.map((t, i) => [t, labels.indexOf(labels[i]) === labels.lastIndexOf(labels[i]) ? labels[i] : report.cases.id[t.case]]));
}

// Values that do not come from a method: what the references alone flicker, and a black image.
export function groundLines(all: Temporal[]): { value: number; words: string }[] {
  const distinct = (of: (t: Temporal) => number | null) => [...new Set(all.map(of).filter((v): v is number => v !== null))];
  return [
    ...distinct((t) => t.noise_floor).map((value) => ({ value, words: "noise floor" })),
    ...distinct((t) => t.unlit).map((value) => ({ value, words: "black image" })),
  ];
}

const base = (width: number, height: number): Plot.PlotOptions => {
  const options = plotDefaults(width, height);
  return { ...options, style: { ...(options.style as object), "--plot-background": "var(--page)" } as unknown as string };
};
const tipStyle = { stroke: "var(--control)", fontSize: 12 } as const;
export const stepsWord: Record<Measure, string> = { derivative: "frame", static: "seed" };

export function valuesChart(page: Page, all: Temporal[]): HTMLElement {
  const names = namesOf(page, all);
  const dots: Dot[] = all.flatMap((t) =>
    (["derivative", "static"] as const)
      .filter((m) => t[m] !== null)
      .map((measure) => ({ label: names.get(t)!, measure, flicker: t[measure]!, ...lookOf(page.digest, methodOf(page.report, t.case)) })),
  );
  const lines = groundLines(all);
  const longest = Math.max(...[...names.values()].map((n) => n.length));
  const make = (width: number) => {
    const marginLeft = Math.min(26 + 7.2 * longest, 0.45 * width);
    const place = { x: (d: Dot) => d.flicker.value, y: "label" };
    return Plot.plot({
      ...base(width, 74 + 24 * names.size),
      marginLeft,
      marginTop: 34,
      x: { label: "change from frame to frame over the mean, derivative (filled) and static (hollow) →", labelAnchor: "right", zero: true, nice: true, grid: true, ...(width < 560 ? { label: "derivative (filled), static (hollow) →", ticks: 5 } : {}) },
      y: { type: "band", domain: [...names.values()], label: null },
      marks: [
        Plot.axisY({ label: null, tickSize: 0, textOverflow: "ellipsis", lineWidth: (marginLeft - 14) / 12 }),
        Plot.ruleX(lines, { x: "value", stroke: "var(--soft)", strokeDasharray: "4 3" }),
        Plot.text(lines, { x: "value", text: "words", frameAnchor: "top", dy: -14, fill: "var(--soft)" }),
        Plot.ruleY(dots, { x1: (d: Dot) => d.flicker.lo, x2: (d: Dot) => d.flicker.hi, y: "label", stroke: "colour", strokeWidth: 1.5 }),
        Plot.dot(dots.filter((d) => d.measure === "derivative"), { ...place, symbol: "symbol", fill: "colour", r: 4.5 }),
        Plot.dot(dots.filter((d) => d.measure === "static"), { ...place, symbol: "symbol", fill: "var(--page)", stroke: "colour", strokeWidth: 1.5, r: 4.5 }),
        Plot.tip(dots, Plot.pointer({ ...place, ...tipStyle, title: (d: Dot) => `${d.label}\n${d.measure} ${figure(d.flicker.value)} (${figure(d.flicker.lo)} to ${figure(d.flicker.hi)})` })),
      ],
      color: { type: "identity" },
    });
  };
  return chart("Flicker of each case with its 95 % interval, beside the references' noise floor and a black image; the table has the figures", make);
}

export function stepsOf(page: Page, all: Temporal[], measure: Measure): Step[] {
  const names = namesOf(page, all);
  const first = measure === "derivative" ? 1 : 0; // the derivative's first entry is frame 1 against frame 0
  return all.flatMap((t, key) => {
    const found = t[measure];
    if (!found) return [];
    const look = lookOf(page.digest, methodOf(page.report, t.case));
    return found.series.map((value, i) => ({ label: names.get(t)!, at: i + first, value, worst: i + first === found.worst_frame, ...look, key }));
  });
}

export function seriesChart(page: Page, all: Temporal[], measure: Measure): HTMLElement {
  const steps = stepsOf(page, all, measure);
  const lines = measure === "derivative" ? groundLines(all) : [];
  const word = stepsWord[measure];
  const place = { x: "at", y: "value" };
  const ticks = [...new Set(steps.map((s) => s.at))];
  const title = (s: Step) => `${s.label}\n${word} ${s.at}${measure === "derivative" ? ` against ${s.at - 1}` : ""}: ${figure(s.value)}${s.worst ? ", the worst" : ""}`;
  const make = (width: number) =>
    Plot.plot({
      ...base(width, 320),
      x: { label: `${word} →`, ticks: ticks.length <= 20 ? ticks : 10, tickFormat: "d", inset: 8 },
      y: { label: `↑ ${measure}`, zero: true, nice: true, grid: true },
      marks: [
        Plot.ruleY(lines, { y: "value", stroke: "var(--soft)", strokeDasharray: "4 3" }),
        measure === "derivative" ? Plot.line(steps, { ...place, z: "key", stroke: "colour", strokeWidth: 1.5 }) : null,
        Plot.dot(steps, { ...place, symbol: "symbol", fill: "colour", r: steps.length > 600 ? 1.5 : 3 }),
        Plot.dot(steps.filter((s) => s.worst), { ...place, symbol: "symbol", r: 6, fill: "colour", stroke: "var(--ink)", strokeWidth: 1.5 }),
        Plot.text(lines, { y: "value", text: "words", frameAnchor: "left", textAnchor: "start", dx: 4, dy: -7, fill: "var(--soft)", stroke: "var(--page)", strokeWidth: 3 }),
        Plot.tip(steps, Plot.pointer({ ...place, ...tipStyle, title })),
      ],
      color: { type: "identity" },
    });
  return chart(`${measure} flicker of each ${word}, the worst of each case marked; the table has the figures`, make, `The worst ${word} of each case is ringed.`);
}
