// Hovering over a chart's points, tapping them, and moving among them with keys: a tip tells of the nearest.
import { pictureOf } from "./charts";
import { h } from "./dom";

export interface Spot {
  x: number; // pixels in the chart
  y: number;
  halfWidth?: number; // of what is no point: all of it is as near as its middle
  halfHeight?: number;
}

const kNear = 28; // pixels to the spot that is read

// A finger leaves what it has read behind; a tap elsewhere takes it away.
let left: { box: HTMLElement; end: () => void } | null = null;
document.addEventListener("pointerdown", (e) => {
  if (!left || left.box.contains(e.target as Node)) return;
  left.end();
  left = null;
});

// Of the spots of a chart, the one that is nearest to a place in it.
function nearestSpot(spots: Spot[], x: number, y: number): number | null {
  let best: number | null = null, least = kNear ** 2;
  spots.forEach((s, i) => {
    const dx = Math.max(0, Math.abs(s.x - x) - (s.halfWidth ?? 0)), dy = Math.max(0, Math.abs(s.y - y) - (s.halfHeight ?? 0));
    const d = dx * dx + dy * dy;
    if (d < least) [best, least] = [i, d];
  });
  return best;
}

// `spots` in the order that the arrow keys follow; `tell` fills the tip; `active` learns which spot is read, null: none.
export function readSpots(box: HTMLElement, width: number, spots: Spot[], tell: (i: number) => (Node | string)[], active?: (i: number | null) => void): void {
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
  const read = (e: PointerEvent) => {
    const r = box.getBoundingClientRect();
    show(nearestSpot(spots, e.clientX - r.left, e.clientY - r.top));
  };
  box.onpointermove = read;
  box.onpointerdown = (e) => {
    read(e);
    if (e.pointerType === "touch") left = { box, end: () => show(null) };
  };
  box.onpointerleave = (e) => e.pointerType !== "touch" && show(null);
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
