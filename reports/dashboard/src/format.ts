// Figures as a reader wants them: three digits, or as many as the interval leaves.
import type { Metric } from "./data";

export type Maybe = number | null | undefined;

// Three significant digits, without an exponent where that is short.
export function figure(v: Maybe, digits = 3): string {
  if (v === null || v === undefined || Number.isNaN(v)) return "–";
  if (!Number.isFinite(v)) return v > 0 ? "∞" : "−∞";
  if (v === 0) return "0";
  const size = Math.abs(v);
  let text: string;
  if (Number.isInteger(v) && size < 10 ** (digits + 1)) text = String(v);
  else if (size >= 1e6 || size < 1e-4) text = v.toExponential(digits - 1).replace("e+", "e");
  else if (size >= 10 ** (digits - 1)) text = v.toFixed(0);
  else text = v.toFixed(Math.max(0, digits - 1 - Math.floor(Math.log10(Number(size.toPrecision(digits))))));
  return text.replace("-", "−").replace("e-", "e−");
}

export function withUnit(v: Maybe, unit: string, digits = 3): string {
  return v === null || v === undefined ? "–" : figure(v, digits) + unit;
}

// "12.3 ms (11.9 to 12.8)"
export function withInterval(v: Maybe, lo: Maybe, hi: Maybe, unit: string): string {
  if (v === null || v === undefined) return "–";
  if (lo === null || lo === undefined || hi === null || hi === undefined || (lo === v && hi === v)) return withUnit(v, unit);
  return `${withUnit(v, unit)} (${figure(lo)} to ${figure(hi)})`;
}

// "+0.8 ms", "−1.2 %"
export function signed(v: Maybe, unit: string): string {
  if (v === null || v === undefined) return "–";
  return (v > 0 ? "+" : "") + withUnit(v, unit);
}

// A ratio as a change: 1.1 is "+10 %", 3 is "×3.00".
export function change(ratio: Maybe): string {
  if (ratio === null || ratio === undefined || !Number.isFinite(ratio)) return "–";
  if (ratio >= 2 || ratio <= 0.5) return "×" + figure(ratio);
  return signed((ratio - 1) * 100, " %");
}

export function metricLabel(m: Metric): string {
  return m.unit.trim() === "" ? m.title : `${m.title} (${m.unit.trim()})`;
}

export function bytes(v: Maybe): string {
  if (v === null || v === undefined) return "–";
  const units = ["B", "kB", "MB", "GB"];
  let at = 0;
  while (v >= 1000 && at < units.length - 1) {
    v /= 1000;
    at += 1;
  }
  return `${figure(v)} ${units[at]}`;
}

// "2026-11-29 01:26 UTC"
export function day(iso: string): string {
  return iso.replace("T", " ").replace(/:\d\d(\.\d+)?Z$/, " UTC");
}
