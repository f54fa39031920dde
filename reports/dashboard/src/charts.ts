// What all charts share: fonts, colours that follow light and dark, ticks of logarithmic axes, and their width.
import * as Plot from "@observablehq/plot";
import { h } from "./dom";
import { figure } from "./format";

// A chart in a frame as wide as the page. `make` draws it for a width, and again when that changes.
export function chart(label: string, make: (width: number) => Element, caption?: string): HTMLElement {
  const box = h("div", { class: "chart", role: "img", "aria-label": label });
  let width = 0;
  const draw = (now: number) => {
    if (now < 50 || Math.abs(now - width) < 2) return;
    width = now;
    const plot = make(now);
    plainMarks(plot);
    box.replaceChildren(plot);
  };
  new ResizeObserver((entries) => draw(Math.floor(entries[0].contentRect.width))).observe(box);
  return h("figure", {}, box, caption ? h("figcaption", {}, caption) : null);
}

// Plot names its marks with aria-label, which an element without a role must not have: data-mark then.
export function plainMarks(plot: Element): void {
  for (const mark of plot.querySelectorAll("[aria-label]")) {
    mark.setAttribute("data-mark", mark.getAttribute("aria-label")!);
    mark.removeAttribute("aria-label");
  }
}

// A plot as one picture with a name.
export function pictureOf(plot: Element, label: string): SVGElement {
  plainMarks(plot);
  const picture = (plot.tagName.toLowerCase() === "svg" ? plot : plot.querySelector("svg")!) as SVGElement;
  picture.setAttribute("role", "img");
  picture.setAttribute("aria-label", label);
  return picture;
}

// Options that every Plot.plot begins with.
export function plotDefaults(width: number, height: number): Plot.PlotOptions {
  const narrow = width < 560;
  return {
    width,
    height,
    marginLeft: 52,
    marginRight: 18,
    marginTop: 26,
    marginBottom: 42,
    style: { background: "transparent", color: "currentColor", fontFamily: "inherit", fontSize: narrow ? "11px" : "12px", overflow: "visible" },
  };
}

// Round numbers between two: all digits of a decade, or fewer where there would be many.
export function logTicks(lo: number, hi: number, most = 12): number[] {
  const ticks: number[] = [];
  const steps = [[1, 2, 3, 4, 5, 6, 7, 8, 9], [1, 2, 3, 5, 7], [1, 2, 5], [1, 3], [1]];
  for (const step of steps) {
    ticks.length = 0;
    for (let e = Math.floor(Math.log10(lo)); e <= Math.ceil(Math.log10(hi)); ++e) {
      for (const s of step) {
        const v = Number(`${s}e${e}`);
        if (v >= lo * 0.9999 && v <= hi * 1.0001) ticks.push(v);
      }
    }
    if (ticks.length <= most) break;
  }
  if (ticks.length >= 2) return ticks;
  // less than an octave: round numbers in between
  const step = 10 ** Math.floor(Math.log10((hi - lo) / 2)) * (hi - lo > 5 * 10 ** Math.floor(Math.log10((hi - lo) / 2)) ? 2 : 1);
  const fine: number[] = [];
  for (let v = Math.ceil(lo / step) * step; v <= hi; v += step) fine.push(Number(v.toPrecision(6)));
  return fine;
}

export function logScale(domain: [number, number]): Plot.ScaleOptions {
  return { type: "log", domain, axis: null };
}

// Axes for logScale with all their ticks labelled; Plot's own leave 5, 50 and 500 without.
export function logAxisX(domain: [number, number], label: string, most = 12): Plot.Markish[] {
  const ticks = logTicks(domain[0], domain[1], most);
  return [Plot.gridX(ticks), Plot.axisX(ticks, { label, text: tick })];
}
export function logAxisY(domain: [number, number], label: string, most = 8): Plot.Markish[] {
  const ticks = logTicks(domain[0], domain[1], most);
  return [Plot.gridY(ticks), Plot.axisY(ticks, { label, text: tick })];
}

export function tick(v: number): string {
  return Number.isInteger(v) && Math.abs(v) < 1e6 ? String(v) : String(Number(figure(v, 4).replace("−", "-")));
}

// The domain of some positive numbers, with room at both ends.
export function logDomain(values: Iterable<number | null | undefined>, room = 1.12): [number, number] {
  let lo = Infinity, hi = 0;
  for (const v of values) {
    if (v === null || v === undefined || !(v > 0) || !Number.isFinite(v)) continue;
    lo = Math.min(lo, v);
    hi = Math.max(hi, v);
  }
  return hi > 0 ? [lo / room, hi * room] : [0.1, 10];
}
