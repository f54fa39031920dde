// What ci/beside measured, as a table: node ci/beside.mjs FOLDER ROUNDS
import { readFileSync } from 'node:fs';

const [folder, rounds] = [process.argv[2], Number(process.argv[3])];
const read = (name, file) => JSON.parse(readFileSync(`${folder}/${name}/${file}`, 'utf8'));

// Milliseconds by what was timed: passes summed over the cases of a run, and building blocks.
function times(name) {
  const found = new Map();
  for (const one of read(name, 'report.json').cases) {
    for (const pass of one.passes ?? [])
      found.set(pass.name, (found.get(pass.name) ?? 0) + pass.median_ms);
  }
  for (const block of read(name, 'blocks.json').blocks) {
    for (const time of block.times) {
      if (time.on_device === false) continue;
      found.set(`${block.block}, ${time.input}, ${time.contestant}, ${time.size}`, time.median_ms);
    }
  }
  return found;
}

const median = (values) => {
  const sorted = [...values].sort((a, b) => a - b);
  const half = sorted.length >> 1;
  return sorted.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
};

const ratios = new Map();
for (let round = 1; round <= rounds; ++round) {
  const [before, after] = [times(`old-${round}`), times(`new-${round}`)];
  for (const [what, ms] of after) {
    if (!before.has(what) || !(ms > 0)) continue;
    if (!ratios.has(what)) ratios.set(what, []);
    ratios.get(what).push({ ratio: before.get(what) / ms, before: before.get(what), after: ms });
  }
}
let slower = 0;
console.log(`${'timed'.padEnd(52)} ${'old ms'.padStart(10)} ${'new ms'.padStart(10)} ${'old/new'.padStart(8)}  range`);
for (const [what, all] of ratios) {
  const values = all.map((one) => one.ratio), sorted = [...values].sort((a, b) => a - b);
  const worse = median(values) < 1 / 1.05 && (sorted[sorted.length - 2] ?? sorted[0]) < 1 / 1.05;
  slower += worse ? 1 : 0;
  const ms = (key) => median(all.map((one) => one[key])).toFixed(3).padStart(10);
  console.log(`${what.padEnd(52)} ${ms('before')} ${ms('after')} ${median(values).toFixed(2).padStart(8)}  ` +
              `${sorted[0].toFixed(2)} … ${sorted.at(-1).toFixed(2)}${worse ? '  slower' : ''}`);
}
console.log(`${rounds} rounds, the two in turn; ${slower} of ${ratios.size} are slower`);
process.exit(slower > 0 ? 4 : 0);
