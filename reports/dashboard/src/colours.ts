// A method's colour and symbol: fixed by its place in the lists of the page's reports, never moved by a filter.
import { symbolCircle, symbolCross, symbolDiamond, symbolSquare, symbolStar, symbolTriangle, symbolWye, symbol as path } from "d3";
import type { SymbolType } from "@observablehq/plot";
import type { Digest, Report } from "./data";
import { svg } from "./dom";

export interface Look {
  colour: string; // for CSS: a variable of style.css, light or dark
  symbol: SymbolType; // Plot's name
}

// Okabe-Ito; black, which is the text's, comes last.
const kColours = 8;
const kSymbols: SymbolType[] = ["circle", "square", "triangle", "diamond", "cross", "star", "wye"];
const kShapes: Record<string, unknown> = { circle: symbolCircle, square: symbolSquare, triangle: symbolTriangle, diamond: symbolDiamond, cross: symbolCross, star: symbolStar, wye: symbolWye };

const known = new WeakMap<Digest, string[]>();

// All methods of the page: those of the first report, then what others add.
export function allMethods(digest: Digest): string[] {
  let names = known.get(digest);
  if (!names) {
    const found = new Set<string>();
    for (const report of digest.reports) report.methods.forEach((m) => found.add(m));
    digest.history?.series.forEach((s) => found.add(s.method));
    digest.stability?.cells.forEach((c) => found.add(c.method));
    names = [...found];
    known.set(digest, names);
  }
  return names;
}

// Seven symbols and eight colours have no common factor: 56 methods differ in one or both.
export function lookAt(place: number): Look {
  return { colour: `var(--method-${place % kColours})`, symbol: kSymbols[place % kSymbols.length] };
}

export function lookOf(digest: Digest, method: string): Look {
  return lookAt(Math.max(0, allMethods(digest).indexOf(method)));
}

// A pass has its stage's hue; passes of one stage fade in the frame's order. By index in Report.passes.
export function passColours(report: Report): string[] {
  const stage = (name: string): string => {
    if (name === "gbuffer" || name === "rsm") return "raster";
    const words = name.split(".");
    const known = words[0] === "generate" ? `generate-${words[1]}` : words[0];
    return kStages.includes(known) ? known : "other";
  };
  const stages = report.passes.map(stage);
  return stages.map((s, i) => {
    const place = stages.slice(0, i).filter((t) => t === s).length, count = stages.filter((t) => t === s).length;
    const share = count < 2 ? 100 : 100 - (60 * place) / (count - 1);
    return `color-mix(in srgb, var(--stage-${s}) ${share.toFixed(0)}%, var(--page))`;
  });
}
const kStages = ["raster", "importance", "generate-rsm", "generate-gbuffer", "visibility", "shade"];

// The symbol alone, for legends; says nothing to a screen reader.
export function swatch(look: Look, size = 12): SVGElement {
  const d = path(kShapes[look.symbol as string], size * 5)() ?? "";
  return svg("svg", { width: size, height: size, viewBox: `${-size / 2} ${-size / 2} ${size} ${size}`, "aria-hidden": "true", class: "swatch" }, svg("path", { d, style: `fill: ${look.colour}` }));
}
