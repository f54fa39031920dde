// How a change is shown, here and in every chart: a shape, a class that gives the colour, and a word.
import { h } from "../dom";

export type ChangeKind = "worse" | "better" | "unclear" | "same";

// Of a word of `vsglbench compare`.
export function kindOf(change: string): ChangeKind {
  if (change === "slower" || change === "worse") return "worse";
  if (change === "faster" || change === "better") return "better";
  return change === "same" ? "same" : "unclear";
}

const glyphs: Record<ChangeKind, string> = { worse: "▲", better: "▼", unclear: "◇", same: "●" };

export function changeText(change: string): string {
  return `${glyphs[kindOf(change)]} ${change}`;
}

// The shape alone, in its colour, before the word.
export function changeGlyph(change: string): HTMLElement {
  return h("span", { class: `change-${kindOf(change)}`, "aria-hidden": "true" }, `${glyphs[kindOf(change)]} `);
}

// An SVG path round (0, 0): up for what grew, down for what shrank.
export function changePath(change: string, r: number): string {
  switch (kindOf(change)) {
    case "worse": return `M0,${-r}L${r},${r * 0.8}L${-r},${r * 0.8}Z`;
    case "better": return `M0,${r}L${r},${-r * 0.8}L${-r},${-r * 0.8}Z`;
    case "unclear": return `M0,${-r}L${r},0L0,${r}L${-r},0Z`;
    default: return `M${-r},0a${r},${r} 0 1,0 ${2 * r},0a${r},${r} 0 1,0 ${-2 * r},0Z`;
  }
}

// "+3.1 %" of 1.031.
export function percentChange(ratio: number): string {
  const p = 100 * (ratio - 1);
  if (Math.abs(p) < 0.05) return "0 %";
  const digits = Math.abs(p) < 10 ? 1 : 0;
  return `${p < 0 ? "−" : "+"}${Math.abs(p).toFixed(digits)} %`;
}

export function changeWithInterval(ratio: number, lo: number, hi: number): string {
  return `${percentChange(ratio)} [${percentChange(lo)} … ${percentChange(hi)}]`;
}
