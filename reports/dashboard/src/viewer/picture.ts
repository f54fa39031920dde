// A picture of the page, decoded when it is first shown.
import parseExr from "parse-exr";
import { bytesOf, type Image } from "../data";

const FLOAT = 1015; // parse-exr's name for Float32Array
const MOST_KEPT = 16;

export interface Picture {
  width: number;
  height: number;
  // Linear RGB and coverage, four floats a pixel, the top row first; null of a PNG, which has no values.
  values: Float32Array | null;
  covered: boolean; // coverage is known; else it is 1 throughout
  png: ImageBitmap | null; // already tone-mapped
}

// parse-exr gives the bottom row first.
function topFirst(data: Float32Array, width: number, height: number): Float32Array {
  const out = new Float32Array(data.length);
  const row = 4 * width;
  for (let y = 0; y < height; ++y) out.set(data.subarray((height - 1 - y) * row, (height - y) * row), y * row);
  return out;
}

export function decodeExr(bytes: Uint8Array): Picture {
  const exr = parseExr(bytes.buffer as ArrayBuffer, FLOAT);
  if (exr.data.length !== 4 * exr.width * exr.height) throw new Error("the picture has no channels R, G and B");
  const covered = (exr.header as { channels: { name: string }[] }).channels.some((c) => c.name === "A");
  return { width: exr.width, height: exr.height, values: topFirst(exr.data as Float32Array, exr.width, exr.height), covered, png: null };
}

export async function decodePng(bytes: Uint8Array): Promise<Picture> {
  const png = await createImageBitmap(new Blob([bytes as BlobPart], { type: "image/png" }));
  return { width: png.width, height: png.height, values: null, covered: false, png };
}

// Those used last are kept.
const kept = new Map<string, Promise<Picture>>();

export function picture(image: Image): Promise<Picture> {
  const key = image.element;
  let found = kept.get(key);
  if (found) kept.delete(key);
  else found = image.format === "exr" ? new Promise((done) => done(decodeExr(bytesOf(key)))) : decodePng(bytesOf(key));
  kept.set(key, found);
  for (const oldest of kept.keys()) {
    if (kept.size <= MOST_KEPT) break;
    kept.delete(oldest);
  }
  return found;
}
