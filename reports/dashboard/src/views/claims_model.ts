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
  ruling: Ruling; // of all trials together, those that a filter hides too
  tried: number; // how many these are
  trials: Claim[]; // those that are shown
}

// What all certain trials say, else "holds in part"; "undecided" where none is certain: as `reproduce` has it.
function whole(trials: Claim[]): Ruling {
  const has = (r: Ruling) => trials.some((t) => rulingOf(t) === r);
  if (has("holds in part") || (has("holds") && has("does not hold"))) return "holds in part";
  if (has("holds")) return "holds";
  if (has("does not hold")) return "does not hold";
  return has("undecided") ? "undecided" : "not run";
}

// A filter hides trials and whole claims, but changes no ruling: that is of `all`.
export function groupsOf(shown: Claim[], all: Claim[]): ClaimGroup[] {
  const every = byName(all);
  return [...byName(shown)].map(([claim, trials]) => ({
    claim,
    text: trials[0].text,
    sources: [...new Set(trials.map((t) => t.source))],
    ruling: whole(every.get(claim) ?? trials),
    tried: (every.get(claim) ?? trials).length,
    trials,
  }));
}

function byName(claims: Claim[]): Map<string, Claim[]> {
  const out = new Map<string, Claim[]>();
  for (const c of claims) {
    if (!out.has(c.claim)) out.set(c.claim, []);
    out.get(c.claim)!.push(c);
  }
  return out;
}

// "MFIS16" of "[MFIS16 §5, Tab. 1]".
export function paperOf(source: string): string {
  return /\[([A-Za-z0-9]+)/.exec(source)?.[1] ?? source;
}
