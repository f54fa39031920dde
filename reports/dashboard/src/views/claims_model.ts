// Claims of papers, and what trials of them found.
import type { Claim } from "../data";

export const rulings = ["holds", "holds in part", "undecided", "does not hold", "not run"] as const;
export type Ruling = (typeof rulings)[number];

export const rulingGlyph: Record<Ruling, string> = { holds: "✓", "holds in part": "◐", undecided: "?", "does not hold": "✗", "not run": "–" };

// papers.json says "in part" for the same.
export function rulingOf(claim: Claim): Ruling {
  if (claim.ruling === "in part") return "holds in part";
  return rulings.find((r) => r === claim.ruling) ?? "undecided";
}

// What a ratio is held against, as `how` says it: "the ratio must be below 0.143".
export interface Bound {
  side: "below" | "above";
  value: number;
}

export function boundOf(how: string): Bound | null {
  const m = /must be (below|above|no more than|no less than|at most|at least) ([0-9.]+(?:e[-+]?\d+)?)/.exec(how);
  if (!m) return null;
  const side = m[1] === "above" || m[1] === "no less than" || m[1] === "at least" ? "above" : "below";
  return { side, value: Number(m[2].replace(/\.$/, "")) };
}

export interface ClaimGroup {
  claim: string;
  text: string;
  sources: string[];
  ruling: Ruling; // of all trials together
  trials: Claim[];
}

// What all certain trials say, else "holds in part"; "undecided" where none is certain: as `reproduce` has it.
function whole(trials: Claim[]): Ruling {
  const has = (r: Ruling) => trials.some((t) => rulingOf(t) === r);
  if (has("holds in part") || (has("holds") && has("does not hold"))) return "holds in part";
  if (has("holds")) return "holds";
  if (has("does not hold")) return "does not hold";
  return has("undecided") ? "undecided" : "not run";
}

export function groupsOf(claims: Claim[]): ClaimGroup[] {
  const byName = new Map<string, Claim[]>();
  for (const c of claims) byName.set(c.claim, [...(byName.get(c.claim) ?? []), c]);
  return [...byName].map(([claim, trials]) => ({
    claim,
    text: trials[0].text,
    sources: [...new Set(trials.map((t) => t.source))],
    ruling: whole(trials),
    trials,
  }));
}

// "MFIS16" of "[MFIS16 §5, Tab. 1]".
export function paperOf(source: string): string {
  return /\[([A-Za-z0-9]+)/.exec(source)?.[1] ?? source;
}
