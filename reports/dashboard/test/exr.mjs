// What the image tests know of pictures, apart from the page: files of the report, formulas of harness/image/metrics.h.
import { existsSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import parseExr from "parse-exr";

const pages = process.env.VSGLBENCH_DASHBOARD_PAGES ?? dirname(fileURLToPath(import.meta.url));

// Top row first, four numbers a pixel; `covered`: channel A is there.
export function decode(bytes) {
  const exr = parseExr(Uint8Array.from(bytes).buffer, 1015);
  const at = (x, y) => Array.from(exr.data.slice(4 * ((exr.height - 1 - y) * exr.width + x)).subarray(0, 4));
  const rows = Array.from({ length: exr.height }, (_, y) => Array.from({ length: exr.width }, (_, x) => at(x, y)));
  return { width: exr.width, height: exr.height, rows, covered: exr.header.channels.some((c) => c.name === "A") };
}

// The other way, in floats and without compression: A, B, G and R of each row.
export function encode({ width, height, rows }) {
  const int = (...v) => Buffer.from(Int32Array.from(v).buffer), text = (s) => Buffer.from(s + "\0");
  const attribute = (name, type, value) => Buffer.concat([text(name), text(type), int(value.length), value]);
  const channels = Buffer.concat([..."ABGR"].map((c) => Buffer.concat([text(c), int(2, 0, 1, 1)])).concat([Buffer.from([0])]));
  const window = int(0, 0, width - 1, height - 1), floats = (...v) => Buffer.from(Float32Array.from(v).buffer);
  const head = Buffer.concat([
    int(20000630, 2), attribute("channels", "chlist", channels), attribute("compression", "compression", Buffer.from([0])),
    attribute("dataWindow", "box2i", window), attribute("displayWindow", "box2i", window), attribute("lineOrder", "lineOrder", Buffer.from([0])),
    attribute("pixelAspectRatio", "float", floats(1)), attribute("screenWindowCenter", "v2f", floats(0, 0)), attribute("screenWindowWidth", "float", floats(1)), Buffer.from([0]),
  ]);
  const lines = rows.map((row, y) => Buffer.concat([int(y, 16 * width), ...[3, 2, 1, 0].map((c) => floats(...row.map((p) => p[c])))]));
  const offsets = lines.map((_, y) => BigInt(head.length + 8 * height + y * lines[0].length));
  return Buffer.concat([head, Buffer.from(BigInt64Array.from(offsets).buffer), ...lines]);
}

// Of a path in the report behind images.html.
export function readPicture(path) {
  const file = join(pages, "images", path);
  if (!existsSync(file)) throw new Error(`${file}: not there`);
  return decode(readFileSync(file));
}

export function* pixelsOf({ x, y, width, height }) {
  for (let v = y; v < y + height; ++v) for (let u = x; u < x + width; ++u) yield [u, v];
}

// Means of x's channels, and SMAPE in per cent and RMSE against r, where r shows a surface; `masked`: or everywhere.
export function expected(x, r, part, masked) {
  let pixels = 0, symmetric = 0, square = 0;
  const mean = [0, 0, 0];
  for (const [u, v] of pixelsOf(part)) {
    const a = x.rows[v][u], b = r.rows[v][u];
    if (masked && b[3] === 0) continue;
    pixels += 1;
    for (let c = 0; c < 3; ++c) {
      const sum = Math.abs(a[c]) + Math.abs(b[c]);
      mean[c] += a[c];
      symmetric += sum > 0 ? Math.abs(a[c] - b[c]) / (sum / 2) : 0;
      square += (a[c] - b[c]) ** 2;
    }
  }
  return { pixels, mean: mean.map((m) => m / pixels), smape: (100 * symmetric) / (3 * pixels), rmse: Math.sqrt(square / (3 * pixels)) };
}

export const luminance = ([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

// (x−r) / ((|x|+|r|)/2) of luminance.
export function signedError(x, r) {
  const [a, b] = [luminance(x), luminance(r)];
  return a + b > 0 ? (a - b) / ((a + b) / 2) : 0;
}

export function encodeSrgb(v) {
  const c = Math.min(Math.max(v, 0), 1);
  return Math.round(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055));
}

// A screenshot of the stage as a function of a place in it -> [R, G, B].
export async function looked(page) {
  const shot = await page.locator(".stage").screenshot();
  const { width, height, data } = await page.evaluate(async (base64) => {
    const image = new Image();
    image.src = "data:image/png;base64," + base64;
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const bytes = context.getImageData(0, 0, image.width, image.height).data;
    let text = "";
    for (let i = 0; i < bytes.length; i += 32768) text += String.fromCharCode(...bytes.subarray(i, i + 32768));
    return { width: image.width, height: image.height, data: btoa(text) };
  }, shot.toString("base64"));
  const bytes = Buffer.from(data, "base64");
  return Object.assign((x, y) => Array.from(bytes.subarray(4 * (Math.floor(y) * width + Math.floor(x)), 4 * (Math.floor(y) * width + Math.floor(x)) + 3)), { width, height });
}
