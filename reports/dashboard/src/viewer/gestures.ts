// Pointer and wheel on a stage: pan, pinch, zoom, the divider, a rectangle.
import { distanceTo, toPixel } from "./scene";
import type { Stage } from "./stage";
import type { Rectangle } from "./statistics";

const NEAR = 9; // CSS pixels from the divider that still take hold of it

export interface Listener {
  drawing(): boolean; // whether a drag draws a rectangle
  changed(): void; // camera, divider or rectangle, at a gesture's end
  hovered(): void; // stage.pixel, or the rectangle while it is drawn
}

type Drag = "pan" | "rectangle" | "divider" | "knob";

export function listen(stage: Stage, size: () => [number, number], listener: Listener): void {
  const { root } = stage;
  const fingers = new Map<number, [number, number]>();
  let drag: Drag | null = null;
  let start: [number, number] = [0, 0]; // pixel of the picture

  const place = (e: { clientX: number; clientY: number }): [number, number] => {
    const { left, top } = root.getBoundingClientRect();
    return [e.clientX - left, e.clientY - top];
  };
  const isSpare = (e: Event) => stage.spare.contains(e.target as Node);
  const pixelAt = (at: [number, number]): [number, number] | null => {
    const pane = stage.paneAt(...at);
    if (!pane) return null;
    const [x, y] = toPixel(pane.box, stage.view(), ...at).map(Math.floor);
    return [x, y];
  };
  const clamped = ([x, y]: [number, number]): [number, number] => [
    Math.min(Math.max(x, 0), size()[0] - 1),
    Math.min(Math.max(y, 0), size()[1] - 1),
  ];

  const kindOf = (e: PointerEvent, at: [number, number]): Drag => {
    if (e.target === stage.knob) return "knob";
    if (e.target === stage.handle) return "divider";
    if (e.shiftKey || listener.drawing()) return "rectangle";
    const pane = stage.panes.length === 1 ? stage.panes[0] : null;
    if (pane && pane.layers.length > 1 && Math.abs(distanceTo(pane.box, stage.divider, ...at)) < NEAR) return "divider";
    return "pan";
  };

  const moveDivider = (at: [number, number]) => {
    const { box } = stage.panes[0];
    const share = (v: number, from: number, length: number) => Math.min(Math.max((v - from) / length, 0), 1);
    stage.divider = { ...stage.divider, x: share(at[0], box.x, box.width), y: share(at[1], box.y, box.height) };
  };
  const turnDivider = (at: [number, number]) => {
    const { box } = stage.panes[0];
    const [dx, dy] = [at[0] - box.x - stage.divider.x * box.width, at[1] - box.y - stage.divider.y * box.height];
    if (Math.hypot(dx, dy) > 4) stage.divider = { ...stage.divider, angle: Math.round((Math.atan2(-dx, dy) * 180) / Math.PI) };
  };
  const drawRectangle = (at: [number, number]) => {
    const pixel = pixelAt(at);
    if (pixel) stage.rectangle = between(start, clamped(pixel));
  };
  const pinch = (id: number, at: [number, number]) => {
    const other = [...fingers].find(([key]) => key !== id)![1];
    const before = fingers.get(id)!;
    const ratio = Math.hypot(at[0] - other[0], at[1] - other[1]) / Math.max(Math.hypot(before[0] - other[0], before[1] - other[1]), 1);
    const middle: [number, number] = [(at[0] + other[0]) / 2, (at[1] + other[1]) / 2];
    stage.zoomTo(stage.view().zoom * ratio, middle, stage.paneAt(...middle)?.box);
    stage.pan((at[0] - before[0]) / 2, (at[1] - before[1]) / 2);
  };

  root.addEventListener("pointerdown", (e) => {
    if (e.button !== 0 || isSpare(e)) return;
    const at = place(e);
    fingers.set(e.pointerId, at);
    root.setPointerCapture(e.pointerId);
    drag = kindOf(e, at);
    const pixel = pixelAt(at);
    if (drag === "rectangle" && pixel) {
      start = clamped(pixel);
      stage.rectangle = between(start, start);
    }
    (e.target === stage.handle || e.target === stage.knob ? (e.target as HTMLElement) : root).focus({ preventScroll: true });
    e.preventDefault();
  });
  root.addEventListener("pointermove", (e) => {
    const at = place(e);
    const before = fingers.get(e.pointerId);
    if (!before || drag === null) {
      const pixel = pixelAt(at);
      stage.pixel = pixel && clamped(pixel).every((v, i) => v === pixel[i]) ? pixel : null;
      const divided = stage.panes.length === 1 && stage.panes[0].layers.length > 1;
      root.style.cursor = e.shiftKey || listener.drawing() ? "crosshair" : divided && kindOf(e, at) === "divider" ? "move" : "grab";
      listener.hovered();
      return stage.redraw();
    }
    if (fingers.size > 1) pinch(e.pointerId, at);
    else if (drag === "pan") stage.pan(at[0] - before[0], at[1] - before[1]);
    else if (drag === "divider") moveDivider(at);
    else if (drag === "knob") turnDivider(at);
    else {
      drawRectangle(at);
      listener.hovered();
    }
    fingers.set(e.pointerId, at);
    stage.redraw();
  });
  const end = (e: PointerEvent) => {
    if (!fingers.delete(e.pointerId)) return;
    if (fingers.size > 0) return;
    drag = null;
    listener.changed();
  };
  root.addEventListener("pointerup", end);
  root.addEventListener("pointercancel", end);
  root.addEventListener("pointerleave", () => {
    if (drag !== null) return;
    stage.pixel = null;
    listener.hovered();
    stage.redraw();
  });
  root.addEventListener(
    "wheel",
    (e) => {
      if (isSpare(e)) return;
      e.preventDefault();
      const at = place(e);
      const lines = e.deltaMode === 1 ? 16 * e.deltaY : e.deltaY;
      stage.zoomTo(stage.view().zoom * 2 ** (-lines / (e.ctrlKey ? 60 : 240)), at, stage.paneAt(...at)?.box);
      listener.changed();
    },
    { passive: false },
  );
}

// Both corners' pixels belong to it.
export function between(a: [number, number], b: [number, number]): Rectangle {
  return {
    x: Math.min(a[0], b[0]),
    y: Math.min(a[1], b[1]),
    width: Math.abs(a[0] - b[0]) + 1,
    height: Math.abs(a[1] - b[1]) + 1,
  };
}
