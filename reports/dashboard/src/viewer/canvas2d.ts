// Draws where WebGL2 is missing: pictures are coloured pixel by pixel on the CPU, and only when the look has changed.
import { INFERNO, mix, NO_SURFACE, NOT_FINITE, SIGNED } from "./ramps";
import { type Camera, type Divider, falseColourAt, type Layer, type Look, type Pane, type Renderer, toScreen, valuesAt } from "./scene";

export function encodeSrgb(value: number): number {
  const v = value > 0 ? Math.min(value, 1) : 0;
  return Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
}

function colourOf(layer: Layer, look: Look, x: number, y: number): readonly number[] {
  const v = valuesAt(layer, x, y);
  if (!v.every(Number.isFinite)) return NOT_FINITE;
  if (layer.kind === "colour") return v.map((c) => encodeSrgb(look.exposure * c));
  if (layer.kind === "luminance") return mix(INFERNO, falseColourAt(v[0], look.exposure));
  if (layer.r?.values?.[4 * (y * layer.x.width + x) + 3] === 0) return NO_SURFACE;
  return layer.kind === "signed" ? mix(SIGNED, 0.5 + v[0] / 200 / look.range) : mix(INFERNO, v[0] / 100 / look.range);
}

function coloured(layer: Layer, look: Look): HTMLCanvasElement {
  const { width, height, png } = layer.x;
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  const context = canvas.getContext("2d")!;
  if (png) {
    context.drawImage(png, 0, 0);
    return canvas;
  }
  const data = context.createImageData(width, height);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) data.data.set([...colourOf(layer, look, x, y), 255], 4 * (y * width + x));
  context.putImageData(data, 0, 0);
  return canvas;
}

export class CanvasRenderer implements Renderer {
  readonly canvas = document.createElement("canvas");
  private drawn = new Map<string, HTMLCanvasElement>();
  private names = new WeakMap<object, number>();
  private count = 0;

  draw(panes: Pane[], camera: Camera, look: Look, divider: Divider): void {
    const context = this.canvas.getContext("2d")!;
    const ratio = window.devicePixelRatio;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    for (const pane of panes) {
      pane.layers.forEach((layer, side) => {
        context.save();
        context.beginPath();
        context.rect(pane.box.x, pane.box.y, pane.box.width, pane.box.height);
        context.clip();
        if (side === 1) this.clipSecond(context, pane, divider);
        const [left, top] = toScreen(pane.box, camera, 0, 0);
        context.imageSmoothingEnabled = camera.zoom * ratio < 1;
        context.drawImage(this.layer(layer, look), left, top, layer.x.width * camera.zoom, layer.x.height * camera.zoom);
        context.restore();
      });
    }
  }

  private clipSecond(context: CanvasRenderingContext2D, { box }: Pane, divider: Divider): void {
    const far = 2 * (box.width + box.height);
    const before = context.getTransform();
    context.translate(box.x + divider.x * box.width, box.y + divider.y * box.height);
    context.rotate((divider.angle * Math.PI) / 180);
    context.beginPath();
    context.rect(0, -far, far, 2 * far);
    context.setTransform(before);
    context.clip();
  }

  private layer(layer: Layer, look: Look): HTMLCanvasElement {
    const key = [layer.kind, this.name(layer.x), layer.r ? this.name(layer.r) : "", look.exposure, look.range].join(" ");
    let found = this.drawn.get(key);
    if (!found) {
      if (this.drawn.size > 12) this.drawn.clear();
      this.drawn.set(key, (found = coloured(layer, look)));
    }
    return found;
  }

  private name(picture: object): number {
    if (!this.names.has(picture)) this.names.set(picture, ++this.count);
    return this.names.get(picture)!;
  }
}
