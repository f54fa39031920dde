// Opens pages in headless Chromium and notes what they must not do. Pages lie in the folder of
// VSGLBENCH_DASHBOARD_PAGES, NAME.html; the report that one was made of beside it, NAME/report.json (make_pages.mjs).
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const pages = process.env.VSGLBENCH_DASHBOARD_PAGES;
if (!pages) throw new Error("VSGLBENCH_DASHBOARD_PAGES: not set; the folder of the pages under test");

let browser;

// -> a page with `errors` (of console and script) and `requests` (all that leave it); both must stay empty.
export async function open(name, { hash = "", dark = false, width = 1280, height = 900 } = {}) {
  const file = join(pages, `${name}.html`);
  if (!existsSync(file)) throw new Error(`${file}: not there`);
  browser ??= await chromium.launch({
    executablePath: process.env.VSGLBENCH_CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: dark ? "dark" : "light", acceptDownloads: true });
  const page = await context.newPage();
  page.setDefaultTimeout(20000);
  page.errors = [];
  page.requests = [];
  page.on("console", (m) => m.type() === "error" && page.errors.push(m.text()));
  page.on("pageerror", (e) => page.errors.push(String(e)));
  page.on("request", (r) => /^(file|data|blob):/.test(r.url()) || page.requests.push(r.url()));
  await page.goto(pathToFileURL(file).href + (hash ? "#" + hash : ""));
  await page.waitForSelector("#view > *");
  return page;
}

// The report.json that a page was made of.
export function report(name) {
  return JSON.parse(readFileSync(join(pages, name, "report.json"), "utf8"));
}

export async function close() {
  await browser?.close();
  browser = undefined;
}

// Numbers of a text as the page writes them: "1.02 (−0.5 to 3e−5)".
export function numbers(text) {
  return (text.match(/[+\-−]?\d+(\.\d+)?(e[\-−]?\d+)?/g) ?? []).map((n) => Number(n.replaceAll("−", "-")));
}

// Whether a figure of three digits is this number.
export function isFigure(shown, exact) {
  return Math.abs(shown - exact) <= 0.0051 * Math.abs(exact) + 1e-12;
}

// The rows of a table by its caption, as objects by the titles of its columns.
export async function rowsOf(page, caption) {
  return page.$$eval("section.table", (sections, wanted) => {
    const section = sections.find((s) => s.querySelector("h3").textContent === wanted);
    if (!section) return null;
    const titles = [...section.querySelectorAll("thead button")].map((b) => b.textContent);
    return [...section.querySelectorAll("tbody tr")].map((tr) => Object.fromEntries([...tr.children].map((cell, i) => [titles[i], cell.textContent])));
  }, caption);
}

// The bytes of what a click saves.
export async function downloaded(page, click) {
  const [download] = await Promise.all([page.waitForEvent("download"), click()]);
  return { name: download.suggestedFilename(), text: readFileSync(await download.path(), "utf8") };
}

// What a table saves, every digit: rows by the titles of its columns, "SMAPE (%)".
export async function saved(page, caption) {
  const { text } = await downloaded(page, () => page.getByRole("button", { name: `Save as CSV: ${caption}`, exact: true }).click());
  const cells = (line) => [...line.matchAll(/("(?:[^"]|"")*"|[^,]*)(?:,|$)/g)].map((m) => m[1].replace(/^"|"$/g, "").replaceAll('""', '"'));
  const [head, ...lines] = text.trim().split("\r\n").map(cells);
  return lines.map((line) => Object.fromEntries(head.map((title, i) => [title, line[i]])));
}

// Pixels of a value on an axis of a chart, in the window, from two of its labelled ticks.
export async function axisOf(page, chart, axis, scale = "log") {
  const ticks = await page.locator(chart).first().locator(`g[data-mark="${axis}-axis tick label"] text`).evaluateAll((texts, side) => texts.map((t) => {
    const box = t.getBoundingClientRect();
    return { value: Number(t.textContent), at: side === "x" ? box.x + box.width / 2 : box.y + box.height / 2 };
  }), axis);
  const f = scale === "log" ? Math.log : (v) => v;
  const a = ticks[0], b = ticks.at(-1);
  return (v) => a.at + ((b.at - a.at) * (f(v) - f(a.value))) / (f(b.value) - f(a.value));
}

// What the tip says when each of these places is pointed at; places are in the window.
export async function tipsAt(page, places) {
  const out = [];
  for (const [x, y] of places) {
    await page.mouse.move(x, y);
    const tip = page.locator(".tip:not([hidden])");
    out.push((await tip.count()) > 0 ? await tip.innerText() : "");
  }
  return out;
}
