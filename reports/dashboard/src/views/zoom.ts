// A rectangle dragged over a chart.
import { h } from "../dom";

export interface Box {
  x0: number;
  x1: number;
  y0: number;
  y1: number;
}

interface Dragging {
  frame(): Box; // of the chart, in pixels of `over`
  zoom(to: Box): void; // pixels, y downwards
  click(x: number, y: number): void;
}

const kLeast = 6; // pixels; less is a click

export function zoomByDragging(over: HTMLElement, d: Dragging): void {
  let from: { x: number; y: number } | null = null;
  const shown = h("div", { class: "brush", hidden: true });
  const at = (e: PointerEvent) => {
    const r = over.getBoundingClientRect();
    return { x: e.clientX - r.left, y: e.clientY - r.top };
  };
  const between = (a: { x: number; y: number }, b: { x: number; y: number }): Box => {
    const f = d.frame();
    const x = (v: number) => Math.min(Math.max(v, f.x0), f.x1), y = (v: number) => Math.min(Math.max(v, f.y0), f.y1);
    return { x0: x(Math.min(a.x, b.x)), x1: x(Math.max(a.x, b.x)), y0: y(Math.min(a.y, b.y)), y1: y(Math.max(a.y, b.y)) };
  };
  const end = () => {
    from = null;
    shown.hidden = true;
  };
  over.addEventListener("pointerdown", (e) => {
    if (e.button !== 0) return;
    from = at(e);
    if (e.pointerType === "mouse") over.setPointerCapture(e.pointerId);
  });
  over.addEventListener("pointermove", (e) => {
    if (!from || e.pointerType === "touch") return;
    const r = between(from, at(e));
    shown.hidden = r.x1 - r.x0 < kLeast || r.y1 - r.y0 < kLeast;
    if (!shown.isConnected) over.append(shown);
    Object.assign(shown.style, { left: `${r.x0}px`, top: `${r.y0}px`, width: `${r.x1 - r.x0}px`, height: `${r.y1 - r.y0}px` });
  });
  over.addEventListener("pointerup", (e) => {
    if (!from) return;
    const to = at(e), r = between(from, to);
    const still = Math.hypot(to.x - from.x, to.y - from.y) < kLeast;
    end();
    if (still) d.click(to.x, to.y);
    else if (r.x1 - r.x0 >= kLeast && r.y1 - r.y0 >= kLeast) d.zoom(r);
  });
  over.addEventListener("pointercancel", end); // a finger scrolls the page
}
