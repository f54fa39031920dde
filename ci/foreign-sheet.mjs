// What ci/foreign-sheet has run, as a table and a picture: node ci/foreign-sheet.mjs OUT FOLDER
import { execFileSync } from 'node:child_process';
import { existsSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join, relative, resolve } from 'node:path';

const [out, folder] = [resolve(process.argv[2]), process.argv[3]];
const columns = 3;
const tile = { width: 240, height: 135 };
const lines = (file) => readFileSync(file, 'utf8').split('\n').filter((line) => line !== '');

// Where view and light come from, of what the scene's warnings say.
const origins = [
  [/a floor and two walls were added/, 'found, with a floor and two walls'],
  [/a view and a spot were found/, 'found'],
  [/a spot was found for its camera/, 'camera of the file, found light'],
  [/a view was found for its light/, 'light of the file, found camera'],
];
const origin = (warnings) =>
  origins.find(([pattern]) => warnings.some((warning) => pattern.test(warning)))?.[1] ?? 'the file\'s';

// Paths of PNGs, of direct light, the reference and the first case that has an image.
function pictures(one, report) {
  const pictured = report.cases.find((c) => c.images?.indirect);
  if (!pictured) return [];
  const [reference, image] = [pictured.images.reference, pictured.images.indirect].map((path) =>
    path.replace(/\.exr$/, '.png'));
  return [join(dirname(reference), 'direct.png'), reference, image].filter((path) => existsSync(join(one, path)))
    .map((path) => join(one, path));
}

function entry(file, number) {
  const one = join(out, `${number}`);
  const [code, begin, end] = lines(join(one, 'outcome'));
  const found = { name: relative(folder, file), code: Number(code), seconds: end - begin, triangles: '', smape: '',
    warnings: [], view: '', pictures: [], ok: 0, cases: 0 };
  const path = join(one, 'report.json');
  if (!existsSync(path)) return { ...found, warnings: lines(join(one, 'stderr')).slice(0, 3) };
  const report = JSON.parse(readFileSync(path, 'utf8'));
  const scene = report.scenes[0];
  found.cases = report.cases.length;
  found.ok = report.cases.filter((c) => c.status === 'ok').length;
  const errors = report.cases.map((c) => c.accuracy?.smape?.value).filter((v) => v !== undefined);
  if (errors.length > 0) found.smape = `${Math.min(...errors).toFixed(1)} … ${Math.max(...errors).toFixed(1)}`;
  const failure = report.cases.find((c) => c.error);
  found.triangles = scene?.triangles ?? '';
  found.warnings = [...(failure ? [failure.error.message] : []), ...(scene?.warnings ?? [])];
  found.view = scene ? origin(scene.warnings ?? []) : '';
  found.pictures = pictures(one, report);
  return found;
}

// Of a file's text, as others read it: nothing of it is markup.
const plain = (text) => [...String(text)].map((c) => (c < ' ' ? ' ' : `&#${c.codePointAt(0)};`)).join('');

const entries = lines(join(out, 'files.txt')).map((file, i) => entry(file, i + 1));
const status = (e) => (e.code === 124 ? 'not done after 300 s' : e.cases > 0 ? `${e.ok} of ${e.cases} ok`
  : `exit code ${e.code}`);

const cell = (text) => String(text).replace(/[\r\n]+/g, ' ').replace(/[|<>&`]/g, (c) => `\\${c}`);
const rows = entries.map((e) => [e.name, status(e), e.seconds.toFixed(1), e.triangles, e.smape, e.view,
  e.warnings.join('; ')]);
const header = ['file', 'status', 'seconds', 'triangles', 'SMAPE %', 'view', 'warnings'];
writeFileSync(join(out, 'table.md'),
  [header, header.map(() => '---'), ...rows].map((row) => `| ${row.map(cell).join(' | ')} |\n`).join(''));

const figure = (e) => `<figure><figcaption>${plain(e.name)}<br>${plain(`${status(e)}, ${e.triangles} triangles, ${
  e.seconds.toFixed(0)} s, SMAPE ${e.smape}; view: ${e.view}`)}</figcaption>${e.pictures.map((path) =>
  `<img src="data:image/png;base64,${readFileSync(path).toString('base64')}">`).join('')
  || `<p>${plain(e.warnings[0] ?? 'no image')}</p>`}</figure>`;
const style = `body{margin:8px;background:#222;color:#ddd;font:13px sans-serif;display:grid;
grid-template-columns:repeat(${columns},${3 * tile.width + 8}px);gap:8px}
figure{margin:0;height:${tile.height + 44}px;overflow:hidden}figcaption{height:38px;overflow:hidden;overflow-wrap:anywhere}
img{width:${tile.width}px;height:${tile.height}px;object-fit:contain;background:#000;image-rendering:pixelated}`;
writeFileSync(join(out, 'sheet.html'),
  `<!doctype html><meta charset="utf-8"><style>${style}</style>${entries.map(figure).join('')}`);
const size = [columns * (3 * tile.width + 16) + 16, Math.ceil(entries.length / columns) * (tile.height + 52) + 16];
execFileSync('chromium', ['--headless', '--no-sandbox', '--disable-gpu', '--hide-scrollbars',
  `--screenshot=${join(out, 'sheet.png')}`, `--window-size=${size}`, `file://${join(out, 'sheet.html')}`],
{ stdio: 'ignore', timeout: 120000 });
if (!readdirSync(out).includes('sheet.png')) throw new Error('chromium has drawn no sheet.png');
console.log(readFileSync(join(out, 'table.md'), 'utf8'));
console.log(join(out, 'sheet.png'));
process.exit(entries.every((e) => e.pictures.length > 0) ? 0 : 1);
