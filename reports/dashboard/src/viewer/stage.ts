// The element in which pictures are looked at: one pane with a divider, or several side by side, under one camera.
import { CanvasRenderer } from "./canvas2d";
import { drawOverlay } from "./overlay";
import { type Box, type Camera, type Divider, fitZoom, type Layer, type Look, type Pane, type Renderer, zoomAt } from "./scene";
import type { Rectangle } from "./statistics";
import { WebGlRenderer } from "./webgl";

// A pane's layers and what is written over it.
export interface Shown {
  titles: string[]; // of each layer
  layers: Layer[];
  note: string; // why there is nothing, else empty
}

const GAP = 2;

function place(e: HTMLElement, { x, y, width, height }: Partial<Box>): void {
  Object.assign(e.style, { left: `${x}px`, top: `${y}px` });
  if (width !== undefined) Object.assign(e.style, { width: `${width}px`, height: `${height}px` });
}

export class Stage {
  readonly root = document.createElement("div");
  readonly handle = document.createElement("button");
  readonly knob = document.createElement("button");
  readonly spare = document.createElement("div"); // the cell beside five panes in three columns; else hidden
  arranged = () => {}; // called when the panes have their places
  fallback = ""; // why the slow renderer draws
  panes: Pane[] = [];
  camera: Camera | null = null; // null: the whole picture
  look: Look = { exposure: 1, range: 1 };
  divider: Divider = { x: 0.5, y: 0.5, angle: 0 };
  rectangle: Rectangle | null = null;
  pixel: [number, number] | null = null;
  private shown: Shown[] = [];
  private size: [number, number] = [1, 1]; // of the pictures
  private renderer: Renderer;
  private overlay = document.createElement("canvas");
  private labels = document.createElement("div");
  private waiting = 0;

  constructor() {
    this.root.className = "stage";
    this.root.tabIndex = 0;
    this.handle.className = "stage-handle";
    this.knob.className = "stage-knob";
    this.overlay.setAttribute("aria-hidden", "true");
    this.renderer = this.makeRenderer();
    this.spare.className = "stage-spare";
    this.root.append(this.renderer.canvas, this.overlay, this.labels, this.spare, this.handle, this.knob);
    new ResizeObserver(() => this.arrange()).observe(this.root);
  }

  show(shown: Shown[], size: [number, number]): void {
    this.shown = shown;
    this.size = size;
    this.arrange();
  }

  // The camera in use: what was chosen, or the whole picture in a pane.
  view(): Camera {
    if (this.camera) return this.camera;
    const box = this.panes[0]?.box ?? { x: 0, y: 0, width: 1, height: 1 };
    return { zoom: fitZoom(box, ...this.size), x: this.size[0] / 2, y: this.size[1] / 2 };
  }

  zoomTo(zoom: number, at?: [number, number], box = this.panes[0]?.box): void {
    if (!box) return;
    const point = at ?? [box.x + box.width / 2, box.y + box.height / 2];
    this.camera = zoomAt(box, this.view(), ...point, zoom);
    this.keepInside();
  }

  pan(dx: number, dy: number): void {
    const camera = this.view();
    this.camera = { ...camera, x: camera.x - dx / camera.zoom, y: camera.y - dy / camera.zoom };
    this.keepInside();
  }

  paneAt(x: number, y: number): Pane | null {
    return this.panes.find(({ box }) => x >= box.x && y >= box.y && x < box.x + box.width && y < box.y + box.height) ?? null;
  }

  redraw(): void {
    if (this.waiting === 0) this.waiting = requestAnimationFrame(() => this.draw());
  }

  private keepInside(): void {
    if (!this.camera) return;
    this.camera.x = Math.min(Math.max(this.camera.x, 0), this.size[0]);
    this.camera.y = Math.min(Math.max(this.camera.y, 0), this.size[1]);
    this.redraw();
  }

  private makeRenderer(): Renderer {
    try {
      return new WebGlRenderer(() => this.fallBack());
    } catch (error) {
      this.fallback = `WebGL2 is missing (${error instanceof Error ? error.message : error}): pictures are drawn without it, more slowly.`;
      return new CanvasRenderer();
    }
  }

  // The GPU has gone.
  private fallBack(): void {
    this.fallback = "WebGL2 was lost: pictures are drawn without it, more slowly.";
    const before = this.renderer.canvas;
    this.renderer = new CanvasRenderer();
    before.replaceWith(this.renderer.canvas);
    this.arrange();
  }

  // Boxes for the panes in columns, the stage's height, labels.
  private arrange(): void {
    const width = this.root.clientWidth;
    if (width === 0 || this.shown.length === 0) return;
    const count = this.shown.length;
    const columns = count === 1 ? 1 : Math.min(count, width >= 900 ? 3 : width >= 520 ? 2 : 1);
    const rows = Math.ceil(count / columns);
    const paneWidth = (width - (columns - 1) * GAP) / columns;
    const most = count === 1 ? Math.max(240, 0.72 * window.innerHeight) : Infinity;
    const paneHeight = Math.round(Math.min((paneWidth * this.size[1]) / this.size[0], most));
    const cell = (i: number): Box => ({
      x: (i % columns) * (paneWidth + GAP),
      y: Math.floor(i / columns) * (paneHeight + GAP),
      width: paneWidth,
      height: paneHeight,
    });
    // Of five in three columns the error maps stand under their images, and the spare cell under the reference.
    const skips = count === 5 && columns === 3;
    this.panes = this.shown.map((s, i) => ({ box: cell(skips && i >= 3 ? i + 1 : i), layers: s.layers }));
    this.spare.hidden = !skips;
    if (skips) place(this.spare, cell(3));
    const height = rows * paneHeight + (rows - 1) * GAP;
    this.root.style.height = `${height}px`;
    for (const canvas of [this.renderer.canvas, this.overlay]) {
      const [w, h] = [width, height].map((v) => Math.round(v * window.devicePixelRatio));
      if (canvas.width !== w) canvas.width = w;
      if (canvas.height !== h) canvas.height = h;
      canvas.style.width = `${width}px`;
      canvas.style.height = `${height}px`;
    }
    this.label();
    this.draw();
    this.arranged();
  }

  private label(): void {
    this.labels.replaceChildren();
    this.shown.forEach((s, i) => {
      const { box } = this.panes[i];
      s.titles.forEach((title, side) => {
        const span = document.createElement("span");
        span.className = "stage-label";
        span.textContent = title;
        span.style.top = `${box.y + 6}px`;
        span.style.maxWidth = `${box.width / s.titles.length - 12}px`;
        if (side === 0) span.style.left = `${box.x + 6}px`;
        else span.style.right = `${this.root.clientWidth - box.x - box.width + 6}px`;
        this.labels.append(span);
      });
      if (s.note) {
        const note = document.createElement("span");
        note.className = "stage-note";
        note.textContent = s.note;
        Object.assign(note.style, { left: `${box.x + 12}px`, top: `${box.y + 40}px`, width: `${box.width - 24}px` });
        this.labels.append(note);
      }
    });
  }

  private draw(): void {
    this.waiting = 0;
    if (this.panes.length === 0) return;
    const camera = this.view();
    const divided = this.panes.length === 1 && this.panes[0].layers.length > 1;
    this.renderer.draw(this.panes, camera, this.look, this.divider);
    drawOverlay(this.overlay, this.panes, camera, { divider: divided ? this.divider : null, rectangle: this.rectangle, pixel: this.pixel });
    this.placeHandle(divided);
    // A finger scrolls the page where there is nothing to pan.
    this.root.style.touchAction = this.panes.length > 1 && !this.camera ? "pan-y" : "none";
  }

  private placeHandle(divided: boolean): void {
    this.handle.hidden = this.knob.hidden = !divided;
    if (!divided) return;
    const { box } = this.panes[0];
    const angle = (this.divider.angle * Math.PI) / 180;
    const [x, y] = [box.x + this.divider.x * box.width, box.y + this.divider.y * box.height];
    const reach = Math.min(70, box.height / 4);
    place(this.handle, { x, y });
    place(this.knob, { x: x - Math.sin(angle) * reach, y: y + Math.cos(angle) * reach });
    const percent = (v: number) => String(Math.round(100 * v));
    this.handle.setAttribute("aria-valuenow", percent(this.divider.x));
    this.handle.setAttribute("aria-valuetext", `${percent(this.divider.x)} % across, ${percent(this.divider.y)} % down`);
    this.knob.setAttribute("aria-valuenow", String(Math.round(this.divider.angle)));
    this.knob.setAttribute("aria-valuetext", `${Math.round(this.divider.angle)} degrees`);
  }
}
