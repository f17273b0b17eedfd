// `kenzan watch`, with its page open in a browser, while an author saves, mistypes, renames, deletes and ends it.
import { spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, renameSync, rmSync, writeFileSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { assert, equal, finish, test } from "./browser.mjs";

/// What is waited for comes within this, or not at all.
const long = 30_000;

/// `$$ .. $$` (1) to (60): long enough to scroll. The equations in `wrong` are false for every choice of declared symbols.
function notes(wrong = []) {
  const display = (k) => `$$ (a + ${k} b)^2 = a^2 + ${2 * k} a b ${wrong.includes(k) ? "-" : "+"} ${k * k} b^2 \\tag{${k}} $$\n\n`;
  const symbols = "<!-- kenzan\n[symbols]\n'a, b' = { range = [1, 2] }\n-->\n\n";
  return `# Squares\n\n${symbols}${Array.from({ length: 60 }, (_, k) => display(k + 1)).join("")}`;
}

/// `kenzan watch` on notes of its own: its lines, its address, and its end.
async function watch(text, args = ["notes.md"]) {
  const folder = mkdtempSync(path.join(os.tmpdir(), "kenzan-watch-"));
  mkdirSync(path.join(folder, ".git"));
  const file = path.join(folder, "notes.md");
  writeFileSync(file, text);
  const process_ = spawn(path.resolve(process.env.KENZAN), ["watch", "--lang", "en", ...args], { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
  const ended = new Promise((done) => process_.on("close", (code, signal) => done({ code, signal })));
  let said = "";
  for (const stream of [process_.stdout, process_.stderr]) stream.on("data", (data) => { said += data; });
  const until = async (pattern) => {
    const begin = Date.now();
    while (!pattern.test(said)) {
      if (Date.now() - begin > long) throw new Error(`${pattern} is not in what watch said:\n${said}`);
      await new Promise((done) => setTimeout(done, 20));
    }
    return said.match(pattern);
  };
  const end = async (signal = "SIGINT") => {
    process_.kill(signal);
    const how = await ended;
    rmSync(folder, { recursive: true, force: true });
    return how;
  };
  return { file, folder, until, end, ended, save: (text) => writeFileSync(file, text), said: () => said };
}

/// A test with a watch and its page.
async function watched(name, text, body, options = {}) {
  const run = await watch(text);
  try {
    const address = (await run.until(/http:\S+/))[0];
    await test(name, "", async (page) => {
      const report = page.frameLocator("#report");
      await report.locator(".equation").first().waitFor({ timeout: long });
      await body({ page, report, run });
    }, { ...options, from: address });
  } finally {
    await run.end();
  }
}

const status = (page, words) => page.waitForFunction((words) => document.getElementById("status").textContent.includes(words), words, { timeout: long });
const inside = (page) => page.frames().find((frame) => frame.url().endsWith("report.html"));
const scrolled = (page) => inside(page).evaluate(() => Math.round(scrollY));
const shown = (report) => report.locator(".equation:visible").count();

await watched("what is saved is judged and the page loads itself anew", notes(), async ({ page, report, run }) => {
  await status(page, "60 hold, all as expected");
  run.save(notes([40]));
  await status(page, "(40) holds → fails; 1 judged in");
  await report.locator(".equation.fails").waitFor({ timeout: long });
  equal(await report.locator(".equation.fails h3").textContent(), "(40)", "what fails");
  equal(await page.title(), await inside(page).title(), "the title");
});

await watched("the reader stays where they were", notes(), async ({ page, report, run }) => {
  await report.locator("#notes-50").scrollIntoViewIfNeeded();
  await page.waitForTimeout(200);
  // The first equation that begins in the window.
  const [id, top] = await inside(page).evaluate(() => {
    const equation = [...document.querySelectorAll(".equation")].find((e) => e.getBoundingClientRect().top > 0);
    return [equation.id, equation.getBoundingClientRect().top];
  });
  assert(await scrolled(page) > 500, `scrolled by ${await scrolled(page)}`);
  run.save(notes([3, 55]));
  await status(page, "(55) holds → fails");
  await report.locator("#notes-3.fails").waitFor({ state: "attached", timeout: long });
  await page.waitForTimeout(500);
  const now = await report.locator(`#${id}`).evaluate((e) => e.getBoundingClientRect().top);
  assert(Math.abs(now - top) < 2, `${id} was at ${top} and is at ${now}, scrolled by ${await scrolled(page)}`);
});

await watched("the filter and the search stay", notes([7, 9]), async ({ page, report, run }) => {
  await report.getByRole("checkbox", { name: "fails" }).click();
  await report.getByRole("searchbox").fill("a^2");
  equal(await shown(report), 2, "failing equations");
  run.save(notes([7, 9, 11]));
  await status(page, "(11) holds → fails");
  await report.locator("#notes-11.fails").waitFor({ state: "attached", timeout: long });
  await page.waitForTimeout(200);
  equal(await report.getByRole("checkbox", { name: "fails" }).isChecked(), true, "the filter");
  equal(await report.getByRole("searchbox").inputValue(), "a^2", "the search");
  equal(await shown(report), 3, "failing equations");
});

await watched("what was opened stays open", notes([7]), async ({ page, report, run }) => {
  const details = report.locator("#notes-7 details").first();
  await details.locator("summary").click();
  run.save(notes([3, 7]));
  await status(page, "(3) holds → fails");
  await report.locator("#notes-3.fails").waitFor({ timeout: long });
  await page.waitForTimeout(200);
  assert(await details.evaluate((d) => d.open), "the details of (7)");
});

await watched("LaTeX that is broken is told, and mended", notes(), async ({ page, report, run }) => {
  run.save(notes().replace("(a + 5 b)^2", "\\left( a + 5 b"));
  await status(page, "(5) holds → unreadable");
  await report.locator("#notes-5.unreadable").waitFor({ timeout: long });
  run.save(notes());
  await status(page, "(5) unreadable → holds");
  await report.locator("#notes-5.holds").waitFor({ timeout: long });
});

await watched("an editor that saves by renaming is followed", notes(), async ({ page, run }) => {
  for (const k of [2, 4]) {
    renameSync(run.file, run.file + "~");
    writeFileSync(path.join(run.folder, ".new"), notes([k]));
    renameSync(path.join(run.folder, ".new"), run.file);
    await status(page, `(${k}) holds → fails`);
  }
});

await watched("notes that are deleted are missed until they come back", notes([6]), async ({ page, report, run }) => {
  rmSync(run.file);
  await status(page, "there is no file `notes.md`");
  await report.locator("#notes-6.fails").waitFor({ timeout: long });
  run.save(notes([6]));
  await status(page, "notes.md: 59 hold, 1 fail");
});

await watched("the page says when the watch has ended", notes(), async ({ page, report, run }) => {
  await run.end();
  await status(page, "kenzan watch has ended");
  equal(await shown(report), 60, "the report is still there");
}, { mayComplain: /ERR_CONNECTION_REFUSED|ERR_EMPTY_RESPONSE|ERR_CONNECTION_RESET|ERR_INCOMPLETE/ });

await finish();
