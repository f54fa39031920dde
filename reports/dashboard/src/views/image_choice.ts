// Which pictures the image view shows: a reference, two methods, and what the methods get wrong.
import { groupIndex } from "../choice";
import type { Digest, Image } from "../data";
import type { Page } from "../view";
import { type Picture, picture } from "../viewer/picture";
import type { Kind, Layer } from "../viewer/scene";

// r: the reference; a, b: two methods; ea, eb: their error maps.
export type ShotId = "r" | "a" | "b" | "ea" | "eb";
export const SHOTS: ShotId[] = ["r", "a", "b", "ea", "eb"];

export interface Chosen {
  candidates: Image[]; // of one scene
  a: Image | null;
  b: Image | null;
  reference: Image | null; // that of a, else of the group
}

export interface Decoded {
  size: [number, number];
  a: Picture | null;
  b: Picture | null;
  reference: Picture | null;
  referenceOfB: Picture | null; // another one where b is of another report
  failures: string[];
}

export interface Shot {
  id: ShotId;
  title: string;
  layer: Layer | null;
  note: string; // why there is none
}

export function isScenePicture(image: Image): boolean {
  return image.kind === "indirect" || image.kind === "reference";
}

const sceneOf = (digest: Digest, image: Image) => digest.reports[image.report]?.scenes[image.scene]?.name;

// All pictures of the group's scene, of the other report too; the same ground truth first.
export function candidatesOf({ digest, report, state }: Page): Image[] {
  const here = digest.reports.indexOf(report);
  const g = groupIndex({ digest, report, state });
  const group = report.groups[g];
  const scene = report.scenes[group?.scene ?? 0]?.name;
  const fits = (image: Image) => {
    if (image.kind !== "indirect" || image.case < 0 || sceneOf(digest, image) !== scene) return false;
    if (image.report === here) return image.group === g || image.group < 0 || !group;
    return digest.reports[image.report].groups[image.group]?.visibility === group?.visibility;
  };
  return digest.images.filter(fits).sort((x, y) => Number(x.report !== here) - Number(y.report !== here));
}

export function referenceOf(digest: Digest, image: Image | null): Image | null {
  if (!image) return null;
  const same = digest.images.filter((i) => i.kind === "reference" && i.report === image.report && i.scene === image.scene);
  return same.find((i) => i.group === image.group) ?? same[0] ?? null;
}

// A and B: what was chosen here, else the selected cases, else the first two of different methods.
export function choose(page: Page): Chosen {
  const { digest, report, state } = page;
  const candidates = candidatesOf(page);
  const here = digest.reports.indexOf(report);
  const asked = (key: string) => candidates.find((i) => String(digest.images.indexOf(i)) === state.get(key));
  const selected = state.list("c").map((c) => candidates.find((i) => i.report === here && i.case === Number(c))).filter((i) => i !== undefined);
  const methodOf = (i: Image) => digest.reports[i.report].cases.method[i.case];
  const a = asked("im.a") ?? selected[0] ?? candidates[0] ?? null;
  const others = candidates.filter((i) => i !== a);
  const sameCase = others.find((i) => a && i.report !== a.report && caseId(digest, i) === caseId(digest, a));
  const b = asked("im.b") ?? selected.find((i) => i !== a) ?? sameCase ?? others.find((i) => a && methodOf(i) !== methodOf(a)) ?? others[0] ?? null;
  const own = digest.images.find((i) => i.kind === "reference" && i.report === here && i.group === groupIndex(page));
  return { candidates, a, b, reference: referenceOf(digest, a) ?? own ?? null };
}

const caseId = (digest: Digest, image: Image) => digest.reports[image.report].cases.id[image.case];

export function labelOf({ digest, report }: Page, image: Image): string {
  const of = digest.reports[image.report];
  const label = of.cases.label[image.case];
  const png = image.format === "png" ? " (PNG, no values)" : "";
  return (of === report ? label : `${label} · ${of.name} ${of.commit.slice(0, 7)}`) + png;
}

export async function decode(digest: Digest, chosen: Chosen): Promise<Decoded> {
  const failures: string[] = [];
  const load = async (image: Image | null) => {
    if (!image) return null;
    return picture(image).catch((error) => {
      failures.push(`A picture can't be read: ${error instanceof Error ? error.message : error}`);
      return null;
    });
  };
  const other = referenceOf(digest, chosen.b);
  const [reference, a, b, referenceOfB] = await Promise.all([chosen.reference, chosen.a, chosen.b, other ?? chosen.reference].map(load));
  const first = reference ?? a ?? b;
  const size: [number, number] = first ? [first.width, first.height] : [1, 1];
  const fitting = (p: Picture | null, what: string) => {
    if (!p || (p.width === size[0] && p.height === size[1])) return p;
    failures.push(`${what} is of ${p.width}×${p.height} pixels, not ${size[0]}×${size[1]}, and is left out.`);
    return null;
  };
  return { size, reference, a: fitting(a, "A"), b: fitting(b, "B"), referenceOfB: fitting(referenceOfB, "B's reference"), failures };
}

const plain = (p: Picture, falseColour: boolean): Kind => (p.values === null ? "png" : falseColour ? "luminance" : "colour");

// Those that the page has something of.
export function shotsOf(page: Page, chosen: Chosen, decoded: Decoded, falseColour: boolean, error: "signed" | "smape"): Shot[] {
  const image = (id: ShotId, title: string, p: Picture | null, there: Image | null): Shot => ({
    id,
    title,
    layer: p ? { kind: plain(p, falseColour), x: p, r: null } : null,
    note: p ? "" : there ? "The picture can't be shown." : "The page has no such picture.",
  });
  const map = (id: ShotId, title: string, x: Picture | null, r: Picture | null): Shot => {
    const layer: Layer | null = x?.values && r?.values ? { kind: error, x, r } : null;
    return { id, title, layer, note: layer ? "" : "An error map needs values: reference and image as EXR." };
  };
  const { a, b } = chosen;
  const shots = [image("r", "reference", decoded.reference, chosen.reference)];
  if (a) shots.push(image("a", `A: ${labelOf(page, a)}`, decoded.a, a));
  if (b) shots.push(image("b", `B: ${labelOf(page, b)}`, decoded.b, b));
  if (a) shots.push(map("ea", "error of A", decoded.a, decoded.reference));
  if (b) shots.push(map("eb", "error of B", decoded.b, decoded.referenceOfB));
  return shots;
}
