// Hovering over a chart's points, and moving among them with keys: a tip tells of the nearest.
import { pictureOf } from "./charts";
import { h } from "./dom";

export interface Spot {
  x: number; // pixels in the chart
  y: number;
}

// `spots` in the order that the arrow keys follow; `tell` fills the tip; `active` learns which spot is read, null: none.
export function readSpots(box: HTMLElement, width: number, spots: Spot[], tell: (i: number) => (Node | string)[], active?: (i: number | null) => void): void {
  const kNear = 28;
  const tip = h("div", { class: "tip", role: "status" });
  tip.hidden = true;
  box.append(tip);
  let now: number | null = null;
  const show = (i: number | null) => {
    if (i === now) return;
    now = i;
    tip.hidden = i === null;
    active?.(i);
    if (i === null) return;
    const { x, y } = spots[i];
    tip.replaceChildren(...tell(i));
    tip.style.left = x > width / 2 ? "" : `${x + 14}px`;
    tip.style.right = x > width / 2 ? `${width - x + 14}px` : "";
    tip.style.top = `${Math.max(0, y - 40)}px`;
  };
  box.onpointermove = (e) => {
    const r = box.getBoundingClientRect();
    let best: number | null = null, least = kNear ** 2;
    spots.forEach((s, i) => {
      const d = (s.x - (e.clientX - r.left)) ** 2 + (s.y - (e.clientY - r.top)) ** 2;
      if (d < least) [best, least] = [i, d];
    });
    show(best);
  };
  box.onpointerleave = () => show(null);
  box.onblur = () => show(null);
  box.onkeydown = (e) => {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[e.key];
    if (e.key === "Escape") show(null);
    if (step === undefined || spots.length === 0) return;
    e.preventDefault();
    show(now === null ? 0 : Math.min(Math.max(now + step, 0), spots.length - 1));
  };
}

// A chart whose points can be read: `make` draws it for a width and gives back its spots.
export function readableChart(label: string, make: (width: number) => { plot: Element; spots: Spot[]; tell(i: number): (Node | string)[]; active?(i: number | null): void }): HTMLElement {
  const box = h("div", { class: "chart", tabindex: 0, role: "group", "aria-label": "Points of the chart: the arrow keys move among them" });
  let width = 0;
  new ResizeObserver((entries) => {
    const now = Math.floor(entries[0].contentRect.width);
    if (now < 50 || Math.abs(now - width) < 2) return;
    width = now;
    const { plot, spots, tell, active } = make(width);
    pictureOf(plot, label);
    box.replaceChildren(plot);
    readSpots(box, width, spots, tell, active);
  }).observe(box);
  return h("figure", {}, box);
}
