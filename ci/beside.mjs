// What ci/beside measured, as a table: node ci/beside.mjs FOLDER ROUNDS
// Times are the least of all samples, which other work on the machine touches last: those of the odd rounds and those
// of the even ones, and what both together say.
import { readFileSync } from 'node:fs';

const [folder, rounds] = [process.argv[2], Number(process.argv[3])];
const read = (name, file) => JSON.parse(readFileSync(`${folder}/${name}/${file}`, 'utf8'));

// Least milliseconds of some rounds by what was timed: passes of each case, and building blocks.
function least(which, some) {
  const found = new Map();
  const see = (what, part, ms) => {
    if (!found.has(what)) found.set(what, new Map());
    const parts = found.get(what);
    parts.set(part, Math.min(ms, parts.get(part) ?? Infinity));
  };
  for (const round of some) {
    for (const one of read(`${which}-${round}`, 'report.json').cases) {
      for (const pass of one.passes ?? []) see(pass.name, one.id, pass.min_ms);
    }
    const blocks = ['small.json', 'large.json'].flatMap((file) => read(`${which}-${round}`, file).blocks);
    for (const block of blocks) {
      for (const time of block.times) {
        if (time.on_device === false) continue;
        see(`${block.block}, ${time.input}, ${time.contestant}, ${time.size}`, '', Math.min(...time.samples_ms));
      }
    }
  }
  return found;
}

const sum = (parts) => [...parts.values()].reduce((a, b) => a + b, 0);
// Where work has moved between two passes, both together, over the cases that have both.
function add_together(found, name, first, second) {
  if (!found.has(first) || !found.has(second)) return;
  const both = new Map();
  for (const [id, ms] of found.get(first)) {
    if (found.get(second).has(id)) both.set(id, ms + found.get(second).get(id));
  }
  found.set(name, both);
}

function compare(some) {
  const [before, after] = [least('old', some), least('new', some)];
  for (const found of [before, after]) {
    for (const half of ['gbuffer', 'rsm'])
      add_together(found, `generate.${half}, resolve and mipmap`, `generate.${half}.resolve`, `generate.${half}.mipmap`);
  }
  const rows = new Map();
  for (const [what, parts] of after) {
    if (before.has(what) && sum(parts) > 0) rows.set(what, { before: sum(before.get(what)), after: sum(parts) });
  }
  return rows;
}

const all = Array.from({ length: rounds }, (_, i) => i + 1);
const together = compare(all);
const halves = rounds > 1 ? [0, 1].map((odd) => compare(all.filter((round) => round % 2 !== odd))) : [together];
let slower = 0;
console.log(`${'timed'.padEnd(52)} ${'old ms'.padStart(10)} ${'new ms'.padStart(10)} ${'old/new'.padStart(8)}  odd, even`);
for (const [what, row] of together) {
  const ratio = (one) => one.before / one.after;
  const each = halves.map((half) => ratio(half.get(what)));
  const worse = [ratio(row), ...each].every((r) => r < 1 / 1.05);
  slower += worse ? 1 : 0;
  const ms = (value) => value.toFixed(3).padStart(10);
  console.log(`${what.padEnd(52)} ${ms(row.before)} ${ms(row.after)} ${ratio(row).toFixed(2).padStart(8)}  ` +
              `${each.map((r) => r.toFixed(2)).join(', ')}${worse ? '  slower' : ''}`);
}
console.log(`${rounds} rounds, the two in turn; ${slower} of ${together.size} are slower`);
process.exit(slower > 0 ? 4 : 0);
