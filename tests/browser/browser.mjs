// What the tests share: the browser, a line for each test.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";

export const pages = process.env.PAGES;
const require = createRequire(path.join(pages, "package.json"));
const { chromium } = require("playwright-core");
export const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

export const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM,
  args: ["--no-sandbox", "--disable-gpu", "--disable-background-networking"],
});

/// The data that a directory's pages were made from.
export const data = (folder) => JSON.parse(readFileSync(path.join(pages, folder, "report.json"), "utf8"));

let failed = 0;
let passed = 0;

/// Opens a page, runs the test, and says how it went. Whatever a page asks for beside files, and whatever it complains
/// of, is a failure. `from` is the address of a server that the page comes from, `mayComplain` what it may complain of.
export async function test(name, file, body, { from = "file:", mayComplain = /^$/, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  const page = await context.newPage();
  const complaints = [];
  const complain = (text) => { if (!mayComplain.test(text)) complaints.push(text); };
  page.on("console", (message) => { if (["error", "warning"].includes(message.type())) complain(message.text()); });
  page.on("pageerror", (error) => complain(error.message));
  page.on("request", (request) => { if (!request.url().startsWith(from)) complaints.push("asks for " + request.url()); });
  try {
    await page.goto(from === "file:" ? pathToFileURL(path.join(pages, file)).href : from);
    await body(page, context);
    if (complaints.length > 0) throw new Error(complaints.join("; "));
    passed += 1;
    console.log(`ok      ${name}`);
  } catch (error) {
    failed += 1;
    console.log(`FAILED  ${name}\n        ${String(error.message).split("\n").slice(0, 12).join("\n        ")}`);
  } finally {
    await context.close();
  }
}

export function equal(found, expected, what) {
  const [a, b] = [found, expected].map((value) => JSON.stringify(value));
  if (a !== b) throw new Error(`${what}: found ${a}, expected ${b}`);
}

export function assert(fact, what) {
  if (!fact) throw new Error(what);
}

export async function finish() {
  await browser.close();
  console.log(`${passed} passed, ${failed} failed`);
  process.exitCode = failed === 0 && passed > 0 ? 0 : 1;
}
