// Opens report pages in headless Chromium and holds them to what they promise.
//
//   node page.mjs PAGE.html… [--shots DIR]
//
// Each page: loads from a file without request and without message; axe-core finds nothing serious, light and dark; no
// sideways scrolling at 390 px; slider, plots, rows, keys and deep links send and hear their events; readable without
// script; prints with all details open. Exits with 1 where one fails. Chromium is CHROMIUM or /usr/bin/chromium.
import { createRequire } from "node:module";
import { existsSync, mkdirSync, readFileSync, statSync } from "node:fs";
import { basename, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const FLAGS = [
  "--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
  "--disable-background-networking", "--disable-component-update",
];
const DESKTOP = { width: 1280, height: 900 };
const PHONE = { width: 390, height: 844 };
const BYTES_MAX = 5_000_000;

const args = process.argv.slice(2);
const shotsAt = args.indexOf("--shots");
const shots = shotsAt >= 0 ? args.splice(shotsAt, 2)[1] : null;
if (args.length === 0) {
  console.error("usage: node page.mjs PAGE.html… [--shots DIR]");
  process.exit(2);
}
if (shots) mkdirSync(shots, { recursive: true });

const axe = findAxe();
if (!axe) console.log("axe-core is not installed: accessibility is skipped");
const executablePath = process.env.CHROMIUM ?? "/usr/bin/chromium";
const browser = await chromium.launch({ executablePath, args: FLAGS });
let failures = 0;
for (const file of args) {
  const path = resolve(file);
  console.log(basename(path));
  check("below 5 MB", statSync(path).size < BYTES_MAX, `${statSync(path).size} bytes`);
  for (const test of [loads, accessible, narrow, timeMoves, findingsMove, deepLinks, withoutScript, prints]) {
    try {
      await test(pathToFileURL(path).href, basename(path, ".html"));
    } catch (error) {
      check(test.name, false, String(error).split("\n")[0]);
    }
    // what a failed test left open would go on drawing
    for (const context of browser.contexts()) await context.close();
  }
}
await browser.close();
console.log(failures === 0 ? "all passed" : `${failures} failed`);
process.exit(failures === 0 ? 0 : 1);

function check(what, passed, detail = "") {
  console.log(`  ${passed ? "ok  " : "FAIL"} ${what}${passed || !detail ? "" : `: ${detail}`}`);
  if (!passed) failures += 1;
}

function findAxe() {
  try {
    const path = createRequire(import.meta.url).resolve("axe-core/axe.min.js");
    return existsSync(path) ? readFileSync(path, "utf8") : null;
  } catch {
    return null;
  }
}

/** Opens a page; what it says and asks for is kept, and every `twin:` event it sends. */
async function open(url, options = {}) {
  const context = await browser.newContext({ viewport: DESKTOP, ...options });
  const page = await context.newPage();
  // the 3-D view draws in software here
  page.setDefaultTimeout(60_000);
  const seen = { messages: [], requests: [] };
  page.on("console", (message) => { if (["error", "warning"].includes(message.type())) seen.messages.push(message.text()); });
  page.on("pageerror", (error) => seen.messages.push(String(error)));
  page.on("request", (request) => { if (!/^(file|data|blob):/.test(request.url())) seen.requests.push(request.url()); });
  await page.addInitScript(() => {
    window.heard = [];
    for (const name of ["twin:time", "twin:finding", "twin:theme"]) {
      document.addEventListener(name, (event) => window.heard.push({ name, ...event.detail }));
    }
  });
  await page.goto(url, { waitUntil: "load" });
  return { context, page, seen };
}

/** Events of a name that were sent so far. */
function heard(page, name) {
  return page.evaluate((wanted) => window.heard.filter((event) => event.name === wanted), name);
}

/** Whether an event of a name comes of which a condition on `event` holds. */
function hears(page, name, condition) {
  const sent = ([wanted, test]) =>
    window.heard.some((event) => event.name === wanted && new Function("event", `return ${test}`)(event));
  return page.waitForFunction(sent, [name, condition], { timeout: 3000 }).then(() => true, () => false);
}

async function loads(url, name) {
  const { context, page, seen } = await open(url);
  await page.waitForTimeout(300);
  // software drawing is slow and says so; that is the browser's word, not the page's
  const messages = seen.messages.filter((text) => !/GPU stall|swiftshader|SwiftShader|WebGL.*fallback/i.test(text));
  check("no message", messages.length === 0, messages.join(" | "));
  check("no request", seen.requests.length === 0, seen.requests.join(" "));
  const policy = await page.getAttribute("meta[http-equiv='Content-Security-Policy']", "content");
  check("policy", policy?.startsWith("default-src 'none'; img-src data:") ?? false, policy ?? "none");
  const broken = await page.$$eval("img", (all) => all.filter((img) => img.complete && img.naturalWidth === 0).length);
  check("pictures can be read", broken === 0, `${broken} broken`);
  const twice = await page.evaluate(() => {
    const ids = [...document.querySelectorAll("[id]")].map((part) => part.id);
    return ids.filter((id, k) => ids.indexOf(id) !== k);
  });
  check("ids are unique", twice.length === 0, twice.join(" "));
  const levels = await page.$$eval("h1, h2, h3, h4", (all) => all.map((part) => Number(part.tagName[1])));
  check("headings in order", levels.every((level, k) => k === 0 ? level === 1 : level <= levels[k - 1] + 1), levels.join(""));
  if (shots) await page.screenshot({ path: join(shots, `${name}-desktop-light.png`), fullPage: true });
  await page.click("#theme");
  const dark = (await heard(page, "twin:theme")).at(-1);
  check("theme is told", dark?.dark === true, JSON.stringify(dark));
  if (shots) await page.screenshot({ path: join(shots, `${name}-desktop-dark.png`), fullPage: true });
  await context.close();
}

async function accessible(url) {
  if (!axe) return;
  for (const colorScheme of ["light", "dark"]) {
    const { context, page } = await open(url, { colorScheme });
    // folded parts too, but not five hundred of them
    await page.evaluate(() => [...document.querySelectorAll("details")].slice(0, 60).forEach((part) => { part.open = true; }));
    await page.evaluate(axe);
    const found = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
    const bad = found.violations.filter((fault) => ["serious", "critical"].includes(fault.impact));
    const told = bad.map((fault) => `${fault.id} ×${fault.nodes.length} ${fault.nodes[0].target} ${fault.nodes[0].failureSummary}`);
    check(`axe-core, ${colorScheme}`, bad.length === 0, told.join(" | ").replaceAll("\n", " "));
    const minor = found.violations.filter((fault) => !bad.includes(fault)).map((fault) => fault.id);
    if (minor.length > 0) console.log(`       lesser: ${minor.join(", ")}`);
    await context.close();
  }
}

async function narrow(url, name) {
  for (const colorScheme of ["light", "dark"]) {
    const { context, page } = await open(url, { viewport: PHONE, colorScheme, hasTouch: true });
    await page.evaluate(() => document.querySelectorAll("details.finding").forEach((row, k) => { row.open = k === 0; }));
    const wide = await page.evaluate(() => [document.scrollingElement.scrollWidth, window.innerWidth]);
    check(`390 px, ${colorScheme}`, wide[0] <= wide[1], wide.join(" in "));
    if (shots) await page.screenshot({ path: join(shots, `${name}-phone-${colorScheme}.png`), fullPage: true });
    await context.close();
  }
}

async function timeMoves(url) {
  const { context, page } = await open(url);
  if (!(await page.$("#slider"))) return context.close();
  const total = Number(await page.getAttribute("#slider", "max"));
  await page.focus("#slider");
  await page.keyboard.press("Home");
  check("slider sends its time", await hears(page, "twin:time", "event.from === 'page' && event.time_s === 0"));
  await page.evaluate((timeS) => document.dispatchEvent(
    new CustomEvent("twin:time", { detail: { time_s: timeS, from: "test" } }),
  ), total / 2);
  const value = Number(await page.inputValue("#slider"));
  check("slider hears others", Math.abs(value - total / 2) < total / 500, String(value));
  const before = (await heard(page, "twin:time")).filter((event) => event.from === "page").length;
  check("what was heard is not sent on", before === 1, String(before));
  if (await page.$("figure[data-plot]")) {
    await page.focus("figure[data-plot]");
    const reading = await page.textContent("figure[data-plot] .reading");
    await page.keyboard.press("ArrowRight");
    check("a plot's cursor moves by keys", (await page.textContent("figure[data-plot] .reading")) !== reading, reading);
    await page.hover("figure[data-plot] svg[role=img]");
    check("a plot sends its time", (await heard(page, "twin:time")).length >= 3);
  }
  if (await page.$("#lanes")) {
    const box = await (await page.$(".lane-field")).boundingBox();
    await page.evaluate(() => document.getElementById("lanes").scrollIntoView({ block: "center" }));
    const at = await (await page.$(".lane-field")).boundingBox();
    await page.mouse.click(at.x + box.width / 4, at.y + 4);
    const last = (await heard(page, "twin:time")).at(-1);
    check("a lane sends its time", Math.abs(last.time_s - total / 4) < total / 100, JSON.stringify(last));
  }
  await context.close();
}

async function findingsMove(url) {
  const { context, page } = await open(url);
  const n = await page.$$eval("details.finding", (all) => all.length);
  if (n === 0) return context.close();
  await page.click("details.finding >> nth=0 >> summary");
  check("a click on a row chooses it", await hears(page, "twin:finding", "event.index === 0"));
  check("a row opens", await page.$eval("details.finding", (row) => row.open));
  check("why is in the row", (await page.$$eval("details.finding[open] .copied", (all) => all.length)) === 1);
  if (n > 1) {
    await page.keyboard.press("j");
    check("j chooses the next", await hears(page, "twin:finding", "event.index === 1"));
    await page.keyboard.press("k");
    check("k goes back", (await heard(page, "twin:finding")).at(-1).index === 0);
  }
  await page.focus("details.finding summary");
  await page.keyboard.press("Enter");
  await page.keyboard.press("Enter");
  check("Enter chooses", (await heard(page, "twin:finding")).length >= 2);
  await page.fill("#by-text", "no such words at all");
  check("the filter filters", (await page.$$eval("details.finding:not([hidden])", (all) => all.length)) === 0);
  await page.fill("#by-text", "");
  await page.selectOption("#by-order", "code");
  const codes = await page.$$eval("details.finding", (all) => all.map((row) => row.dataset.code));
  check("rows are put in order", codes.every((code, k) => k === 0 || codes[k - 1] <= code), codes.slice(0, 5).join());
  await context.close();
}

async function deepLinks(url) {
  const { context, page } = await open(`${url}#t=1.5`);
  if (await page.$("#slider")) {
    const total = Number(await page.getAttribute("#slider", "max"));
    check("#t= goes to a time", await hears(page, "twin:time", `Math.abs(event.time_s - ${Math.min(1.5, total)}) < 1e-6`));
  }
  await context.close();
  const other = await open(`${url}#finding-1`);
  if (await other.page.$("#finding-1")) {
    check("#finding- chooses it", await hears(other.page, "twin:finding", "event.index === 0"));
    check("#finding- opens its row", await other.page.$eval("details.finding", (row) => row.open));
  }
  await other.context.close();
}

async function withoutScript(url, name) {
  const { context, page, seen } = await open(url, { javaScriptEnabled: false });
  const text = await page.innerText("main");
  check("readable without script", /FEASIBLE/.test(text) && /Provenance/.test(text));
  check("no control without its script", (await page.locator(".js-only:visible").count()) === 0);
  check("no request without script", seen.requests.length === 0, seen.requests.join(" "));
  const first = page.locator("details.finding").first();
  if (await first.count()) {
    await first.locator("summary").click();
    check("a row opens without script", await first.locator(".message").isVisible());
  }
  if (shots) await page.screenshot({ path: join(shots, `${name}-no-script.png`) });
  await context.close();
}

async function prints(url, name) {
  const { context, page } = await open(url);
  const path = shots ? join(shots, `${name}.pdf`) : undefined;
  const pdf = await page.pdf({ format: "A4", path });
  check("prints", pdf.length > 10_000, `${pdf.length} bytes`);
  await page.emulateMedia({ media: "print" });
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  check("paper has all details", (await page.$$eval("details:not([open])", (all) => all.length)) === 0);
  check("paper has no controls", (await page.locator("main .js-only:visible").count()) === 0);
  await context.close();
}
