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
