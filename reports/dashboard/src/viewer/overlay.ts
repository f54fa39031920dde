// Lines and figures over the pictures: divider, chosen rectangle, the pixel under the pointer, values in the pixels.
import { figure } from "../format";
import { type Camera, type Divider, isSecond, type Layer, type Pane, toPixel, toScreen, valuesAt } from "./scene";
import type { Rectangle } from "./statistics";

const LEAST_PIXEL = 44; // from this size on, values are printed in it

export interface Marks {
  divider: Divider | null;
  rectangle: Rectangle | null;
  pixel: [number, number] | null;
}

export function drawOverlay(canvas: HTMLCanvasElement, panes: Pane[], camera: Camera, marks: Marks): void {
  const ratio = window.devicePixelRatio;
  const context = canvas.getContext("2d")!;
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  for (const pane of panes) {
    context.save();
    context.beginPath();
    context.rect(pane.box.x, pane.box.y, pane.box.width, pane.box.height);
    context.clip();
    if (camera.zoom >= LEAST_PIXEL) printValues(context, pane, camera, marks.divider);
    if (marks.pixel) outline(context, pane, camera, { x: marks.pixel[0], y: marks.pixel[1], width: 1, height: 1 }, []);
    if (marks.rectangle) outline(context, pane, camera, marks.rectangle, [5, 4]);
    if (marks.divider && pane.layers.length > 1) drawDivider(context, pane, marks.divider);
    context.restore();
  }
}

// A light line on a dark one, to be seen on anything.
function stroke(context: CanvasRenderingContext2D, dash: number[]): void {
  context.setLineDash([]);
  context.lineWidth = 3;
  context.strokeStyle = "rgb(0 0 0 / 70%)";
  context.stroke();
  context.setLineDash(dash);
  context.lineWidth = 1;
  context.strokeStyle = "white";
  context.stroke();
}

function outline(context: CanvasRenderingContext2D, pane: Pane, camera: Camera, r: Rectangle, dash: number[]): void {
  const [left, top] = toScreen(pane.box, camera, r.x, r.y);
  context.beginPath();
  context.rect(left, top, r.width * camera.zoom, r.height * camera.zoom);
  stroke(context, dash);
}

function drawDivider(context: CanvasRenderingContext2D, { box }: Pane, divider: Divider): void {
  const angle = (divider.angle * Math.PI) / 180;
  const far = box.width + box.height;
  const [x, y] = [box.x + divider.x * box.width, box.y + divider.y * box.height];
  const [dx, dy] = [-Math.sin(angle) * far, Math.cos(angle) * far];
  context.beginPath();
  context.moveTo(x - dx, y - dy);
  context.lineTo(x + dx, y + dy);
  stroke(context, []);
}

function printValues(context: CanvasRenderingContext2D, pane: Pane, camera: Camera, divider: Divider | null): void {
  const { box, layers } = pane;
  if (layers.length === 0) return;
  const [x0, y0] = toPixel(box, camera, box.x, box.y).map(Math.floor);
  const [x1, y1] = toPixel(box, camera, box.x + box.width, box.y + box.height).map(Math.floor);
  const size = Math.min(camera.zoom / 4.6, 15);
  context.font = `${size}px ui-monospace, Menlo, Consolas, monospace`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (let y = Math.max(y0, 0); y <= y1; ++y) {
    for (let x = Math.max(x0, 0); x <= x1; ++x) {
      const [left, top] = toScreen(box, camera, x, y);
      const middle: [number, number] = [left + camera.zoom / 2, top + camera.zoom / 2];
      const layer = divider && isSecond(pane, divider, ...middle) ? layers[1] : layers[0];
      print(context, layer, valuesAt(layer, x, y), middle, size);
    }
  }
}

const CHANNELS = ["rgb(255 150 150)", "rgb(140 240 140)", "rgb(160 190 255)"];

function print(context: CanvasRenderingContext2D, layer: Layer, values: number[], at: [number, number], size: number): void {
  values.forEach((v, i) => {
    const y = at[1] + (i - (values.length - 1) / 2) * size * 1.2;
    const text = layer.kind === "signed" || layer.kind === "smape" ? v.toFixed(1).replace("-", "−") : figure(v);
    context.lineWidth = 3;
    context.lineJoin = "round";
    context.strokeStyle = "rgb(0 0 0 / 80%)";
    context.strokeText(text, at[0], y);
    context.fillStyle = values.length === 3 ? CHANNELS[i] : "white";
    context.fillText(text, at[0], y);
  });
}
