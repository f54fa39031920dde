// What the viewer draws: panes of layers, all under one camera. Lengths on the screen are CSS pixels.
import type { Picture } from "./picture";
import { luminance, pixelSmape, signedError } from "./statistics";

// colour: tone-mapped; luminance: in false colours; signed and smape: x against r; png: as it is.
export type Kind = "colour" | "luminance" | "signed" | "smape" | "png";

export interface Layer {
  kind: Kind;
  x: Picture;
  r: Picture | null;
}

export interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

// Of two layers the second lies where (cos angle, sin angle) points to, seen from the line through (x, y).
export interface Divider {
  x: number; // share of the pane, 0 … 1
  y: number;
  angle: number; // degrees
}

export interface Pane {
  box: Box; // in the stage
  layers: Layer[]; // one or two
}

export interface Look {
  exposure: number; // factor
  range: number; // signed errors reach from −range to range, smape from 0 to 100 range: 1 is 100 %
}

export interface Camera {
  zoom: number; // CSS pixels a pixel of the picture
  x: number; // pixel of the picture in a pane's middle
  y: number;
}

export interface Renderer {
  readonly canvas: HTMLCanvasElement;
  draw(panes: Pane[], camera: Camera, look: Look, divider: Divider): void;
}

// False colours of luminance run over so many powers of two of luminance × exposure.
export const STOPS = { low: -8, high: 2 };

export const falseColourAt = (y: number, exposure: number) =>
  y * exposure > 0 ? (Math.log2(y * exposure) - STOPS.low) / (STOPS.high - STOPS.low) : 0;

// Where the left upper corner of pixel (x, y) is on the screen; whole device pixels, so that no edge is blurred.
export function toScreen(box: Box, camera: Camera, x: number, y: number, ratio = window.devicePixelRatio): [number, number] {
  const snap = (v: number) => Math.round(v * ratio) / ratio;
  const left = snap(box.x + box.width / 2 - camera.x * camera.zoom);
  const top = snap(box.y + box.height / 2 - camera.y * camera.zoom);
  return [left + x * camera.zoom, top + y * camera.zoom];
}

export function toPixel(box: Box, camera: Camera, sx: number, sy: number): [number, number] {
  const [left, top] = toScreen(box, camera, 0, 0);
  return [(sx - left) / camera.zoom, (sy - top) / camera.zoom];
}

export function fitZoom(box: Box, width: number, height: number): number {
  return Math.min(box.width / width, box.height / height);
}

// The pixel under (sx, sy) stays there.
export function zoomAt(box: Box, camera: Camera, sx: number, sy: number, zoom: number): Camera {
  const to = Math.min(Math.max(zoom, 0.05), 256);
  const [dx, dy] = [sx - box.x - box.width / 2, sy - box.y - box.height / 2];
  return { zoom: to, x: camera.x + dx / camera.zoom - dx / to, y: camera.y + dy / camera.zoom - dy / to };
}

// Where (x, y) lies on the divider's second side.
export function isSecond(pane: Pane, divider: Divider, sx: number, sy: number): boolean {
  return pane.layers.length > 1 && distanceTo(pane.box, divider, sx, sy) >= 0;
}

export function distanceTo(box: Box, divider: Divider, sx: number, sy: number): number {
  const angle = (divider.angle * Math.PI) / 180;
  return (sx - box.x - divider.x * box.width) * Math.cos(angle) + (sy - box.y - divider.y * box.height) * Math.sin(angle);
}

// What a layer shows at a pixel: three numbers of a colour, one of anything else, none of a PNG.
export function valuesAt(layer: Layer, x: number, y: number): number[] {
  const { x: picture, r, kind } = layer;
  const v = picture.values;
  if (!v || x < 0 || y < 0 || x >= picture.width || y >= picture.height) return [];
  const at = 4 * (y * picture.width + x);
  if (kind === "colour") return [v[at], v[at + 1], v[at + 2]];
  if (kind === "luminance") return [luminance(v[at], v[at + 1], v[at + 2])];
  if (!r?.values) return [];
  return [kind === "signed" ? 100 * signedError(v, r.values, at) : pixelSmape(v, r.values, at)];
}
