// Each role does its job from logging in to logging out, at a desk and on a phone, in Debian's Chromium. On each page:
// no error on the console, nothing serious by axe, nothing wider than the screen. Then the same pages without scripts,
// and in the dark.
//
//   node roles.mjs PROGRAM LIBRARY OUT      LIBRARY is that of `seldinger demo --drills`; its passwords are set anew
import { execFileSync, spawn } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { randomBytes } from "node:crypto";
import { createInterface } from "node:readline";
import axe from "axe-core";
import { chromium } from "playwright-core";

const [program, library, out] = process.argv.slice(2);
mkdirSync(out, { recursive: true });
const password = randomBytes(18).toString("base64url");
const faults = new Set();
const report = (words) => {
  if (!faults.has(words)) console.error(words);
  faults.add(words);
};
const command = (words, input) =>
  execFileSync(program, [...words, "--library", library], { input, encoding: "utf8", stdio: ["pipe", "pipe", "inherit"] });

// What the drills' library lacks: two roles, a cohort with its mentor and its director, a study.
function fill() {
  for (const name of ["researcher", "admin"]) command(["user", "add", name, "--role", name], password);
  for (const name of ["trainee", "mentor", "director"]) command(["user", "passwd", name], password);
  command(["cohort", "add", "Autumn", "--programme", "Radiology"]);
  command(["cohort", "enrol", "Autumn", "--user", "trainee"]);
  command(["cohort", "enrol", "Autumn", "--user", "mentor", "--mentor"]);
  command(["cohort", "direct", "Radiology", "--user", "director"]);
  command(["study", "new", "Needles in phantoms"]);
  command(["study", "researcher", "Needles", "--user", "researcher"]);
  command(["study", "template", "--case", "Drill 1", "--out", `${out}/plan.json`]);
  const plan = readFileSync(`${out}/plan.json`, "utf8").replaceAll("REPLACE: ", "");  // as if it were filled in
  writeFileSync(`${out}/plan.json`, plan);
  command(["study", "plan", "Needles", `${out}/plan.json`]);
  command(["study", "freeze", "Needles"]);
}
const ROLES = ["trainee", "mentor", "researcher", "director", "admin"];

const WIDE = { width: 1280, height: 900 }, NARROW = { width: 390, height: 844 };
let where = "";
const expect = (holds, words) => {
  if (!holds) report(`${where}: ${words}`);
};

// A picture is kept of a page with a fault; of all pages tests/gallery/pages.py takes one.
async function look(page, name) {
  const at = `${where} ${name}`, before = faults.size;
  await page.waitForLoadState("load");
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
  if (wide > 1) report(`${at}: ${wide} px wider than the screen`);
  await page.evaluate(axe.source);
  const found = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  for (const one of found.violations)
    if (one.impact === "serious" || one.impact === "critical")
      report(`${at}: axe ${one.id}: ${one.nodes.slice(0, 3).map((node) => node.target.join(" ")).join(", ")}`);
  if (faults.size > before) await page.screenshot({ path: `${out}/${where.replaceAll(" ", "-")}-${name}.png`, fullPage: true });
}

async function logIn(context, base, name) {
  const page = await context.newPage();
  page.on("console", (message) => {
    if (message.type() === "error") report(`${where} ${page.url()}: console: ${message.text()}`);
  });
  page.on("pageerror", (error) => report(`${where} ${page.url()}: ${error.message}`));
  await page.goto(base + "/");
  await page.getByLabel("Name").fill(name);
  await page.getByLabel("Password").fill(password);
  await page.getByRole("button", { name: "Log in" }).click();
  await page.waitForURL(base + "/");
  return page;
}
async function logOut(page, base) {
  await page.getByRole("button", { name: "Log out" }).click();
  await page.waitForURL(base + "/login");
}
const heading = (page) => page.locator("h1").textContent();

// Plays the replay, turns it and finds the moment of a comment.
async function replay(page, comment) {
  const canvas = page.locator("canvas");
  await canvas.waitFor({ state: "visible" });
  await page.waitForLoadState("networkidle");  // the skin is there
  await page.locator(".replay3d").screenshot({ path: `${out}/${where.replaceAll(" ", "-")}-replay.png` });
  await page.getByRole("button", { name: "As a CT slice" }).click();
  await canvas.press("ArrowLeft");
  const told = page.locator("[data-told]");
  const before = await told.textContent();
  await page.getByRole("slider").fill("0");
  expect((await told.textContent()) !== before, "the slider leads nowhere");
  await page.getByLabel("Speed").selectOption("4");
  await page.getByRole("button", { name: "Play", exact: true }).click();
  await page.waitForFunction(() => Number(document.querySelector("input[type=range]").value) > 0);
  if (!comment) return;
  await page.locator(".comments button.moment").first().click();
  expect((await page.locator("[data-said]").textContent()).includes(comment), "the comment is not shown at its moment");
}

// A body of 40 HU in air, 160 x 160 x 90 mm, as one MetaImage file.
function ct() {
  const size = [64, 64, 30], voxels = new Int16Array(size[0] * size[1] * size[2]);
  for (let i = 0; i < voxels.length; ++i) {
    const x = (i % 64) - 31.5, y = (Math.floor(i / 64) % 64) - 31.5;
    voxels[i] = (x / 26) ** 2 + (y / 18) ** 2 < 1 ? 40 + (i % 7) : -1000;
  }
  const head = "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nOffset = 0 0 0\n" +
    "TransformMatrix = 1 0 0 0 1 0 0 0 1\nElementSpacing = 2.5 2.5 3\nDimSize = 64 64 30\nElementType = MET_SHORT\n" +
    "ElementDataFile = LOCAL\n";
  return Buffer.concat([Buffer.from(head), Buffer.from(voxels.buffer)]);
}

const jobs = {
  async trainee(page, base) {
    expect((await heading(page)) === "What is next", "lands elsewhere");
    await look(page, "start");
    await page.getByRole("link", { name: "Your progress and learning curves" }).click();
    expect((await heading(page)) === "Your progress", "no progress");
    await page.locator("details.learned").first().waitFor();
    expect((await page.locator("details.learned[open] svg.series").count()) > 1, "no learning curve");
    await page.locator("details.learned[open]").getByText("The charts as a table").click();
    await look(page, "progress");
    await page.getByRole("link", { name: "Attempts", exact: true }).click();
    await ordered(page);
    await look(page, "attempts");
    await page.getByRole("link", { name: "Seldinger" }).click();
    await page.locator("dl.definitions dt a").first().click();  // what a mentor said
    await replay(page, said);
    await look(page, "attempt");
    await page.getByRole("link", { name: "What was on the screen" }).click();
    await page.locator(".strip img").first().waitFor();
    const broken = await page.locator(".strip img").evaluateAll(async (all) => {
      for (const one of all) one.loading = "eager";
      await Promise.all(all.map((one) => one.decode().catch(() => {})));
      return all.filter((one) => one.naturalWidth !== Number(one.getAttribute("width"))).length;
    });
    expect(broken === 0, `${broken} small pictures are not there`);
    await look(page, "pictures");
    const whole = await page.request.get(await page.locator(".strip a").first().evaluate((one) => one.href));
    expect(whole.ok() && whole.headers()["content-type"] === "image/png", "the whole picture does not open");
    await page.getByRole("link", { name: "About you" }).click();
    await page.getByRole("button", { name: "Save" }).click();
    await page.getByText("Saved.").waitFor();
    await look(page, "me");
  },
  async mentor(page, base) {
    expect((await heading(page)) === "What waits for you", "lands elsewhere");
    await look(page, "start");
    await page.locator("ul.standings a").first().click();
    await page.getByLabel("State").selectOption("");
    await page.getByRole("button", { name: "Show" }).click();
    await look(page, "learners");
    await page.locator("table.learners tbody a").first().click();
    await look(page, "learner");
    await page.locator("svg.passes a").first().click();
    await replay(page);
    await page.getByLabel("At second").fill("0.5");
    await page.getByLabel("Comment", { exact: true }).fill(said);
    await page.getByRole("button", { name: "Add comment" }).click();
    await page.locator("dl dd", { hasText: said }).first().waitFor();
    await replay(page, said);
    await look(page, "attempt");
    await page.getByRole("link", { name: "Cases" }).click();
    await look(page, "cases");
    await page.locator("table.list tbody a").first().click();
    await look(page, "case");
    await page.getByRole("link", { name: "Jobs" }).click();
    await look(page, "jobs");
    const title = "Sent by a " + where;
    await page.getByLabel("Title of the case").fill(title);
    await page.getByRole("button", { name: "Choose its files" }).click();
    await page.getByLabel("Or one file").waitFor();
    await look(page, "job-files");
    await page.getByLabel("Or one file").setInputFiles({ name: "ct.mha", mimeType: "application/octet-stream", buffer: ct() });
    await page.getByRole("link", { name: "Go to the case" }).waitFor();
    await look(page, "job-done");
    await page.getByRole("link", { name: "Go to the case" }).click();
    expect((await heading(page)).includes(title), "the case that was sent is not there");
  },
  async researcher(page, base) {
    expect((await heading(page)) === "Your studies", "lands elsewhere");
    await look(page, "start");
    await page.getByRole("link", { name: "Needles in phantoms" }).click();
    await look(page, "study");
    await page.getByRole("button", { name: "Make the validity report" }).click();
    await page.getByRole("link", { name: "validity-report.html" }).waitFor();
    await look(page, "job-done");
    const [report] = await Promise.all([
      page.waitForEvent("download"), page.getByRole("link", { name: "validity-report.html" }).click()]);
    expect(report.suggestedFilename() === "validity-report.html", "no report");
    await page.getByRole("link", { name: "Attempts" }).first().click();
    expect(!(await page.content()).includes(">trainee<"), "a name is read");
    await look(page, "attempts");
  },
  async director(page, base) {
    expect((await heading(page)) === "What waits for you", "lands elsewhere");
    await look(page, "start");
    await page.locator("ul.standings a").first().click();
    await page.getByLabel("State").selectOption("");
    await page.getByRole("button", { name: "Show" }).click();
    await ordered(page);
    await look(page, "learners");
    await page.locator("table.learners tbody a").first().click();
    await page.getByRole("link", { name: "Record to print" }).click();
    expect((await heading(page)) === "Training record", "no record");
    await look(page, "record");
    await page.getByRole("link", { name: "Cohorts" }).click();
    await look(page, "cohorts");
    await page.getByRole("link", { name: "Curriculum" }).click();
    await look(page, "curricula");
    await page.getByRole("link", { name: "Stations" }).click();
    await look(page, "stations");
  },
  async admin(page, base) {
    expect((await heading(page)) === "This server", "lands elsewhere");
    await look(page, "start");
    await page.getByRole("link", { name: "Audit", exact: true }).click();
    await ordered(page);
    await page.getByLabel("Only rows with").fill("logs in");
    expect((await page.locator("tbody tr:visible").count()) > 0, "the filter hides all");
    await look(page, "audit");
    await page.getByRole("link", { name: "Stations" }).click();
    await look(page, "stations-timing");
    await page.getByRole("link", { name: "Log-ins" }).click();
    await look(page, "log-ins");
    await page.getByRole("link", { name: "Accounts" }).click();
    const newcomer = where.replaceAll(" ", "-");
    await page.getByLabel("Name").fill(newcomer);
    await page.getByRole("button", { name: "Make a one-time link" }).click();
    await look(page, "accounts");
    const theirs = await page.context().browser().newContext({ viewport: page.viewportSize() });
    const their = await theirs.newPage();
    await their.goto(await page.locator(".message code").textContent());
    await look(their, "password");
    for (const name of ["New password", "Repeat password"]) await their.getByLabel(name).fill(password);
    await their.getByRole("button", { name: "Set it" }).click();
    await their.getByLabel("Name").fill(newcomer);
    await their.getByLabel("Password").fill(password);
    await their.getByRole("button", { name: "Log in" }).click();
    await their.waitForURL(base + "/");
    expect((await heading(their)) === "What is next", "who was invited lands elsewhere");
    await theirs.close();
  },
};

// By the head where it is seen, else by the list of heads; with the keyboard.
async function ordered(page) {
  await page.locator(".table-bar").first().waitFor({ state: "attached" });
  const head = page.locator("thead button.order").first();
  if (await head.isVisible()) {
    await head.focus();
    await page.keyboard.press("Enter");
    await page.keyboard.press("Enter");
  } else {
    await page.locator(".order-by select").first().selectOption({ index: 0 });
  }
  const how = await page.locator("th[aria-sort]").first().getAttribute("aria-sort");
  expect(how === "ascending" || how === "descending", "the list is in no order");
}

const said = "Breathe out before you go in";

async function main() {
  fill();
  const server = spawn(program, ["serve", "--library", library, "--port", "0"], { stdio: ["ignore", "pipe", "ignore"] });
  const base = (await createInterface({ input: server.stdout })[Symbol.asyncIterator]().next()).value.trim();
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM || "/usr/bin/chromium", args: ["--no-sandbox"] });
  try {
    for (const [size, viewport] of [["wide", WIDE], ["narrow", NARROW]])
      // A mentor first: what they say is read by the trainee.
      for (const role of ["mentor", "trainee", "researcher", "director", "admin"]) {
        where = `${role} ${size}`;
        const context = await browser.newContext({ viewport });
        context.setDefaultTimeout(60_000);
        const page = await logIn(context, base, role);
        try {
          await jobs[role](page, base);
          await logOut(page, base);
        } catch (error) {
          await page.screenshot({ path: `${out}/${where.replaceAll(" ", "-")}-stuck.png`, fullPage: true });
          report(`${where} at ${page.url()} (${await heading(page)}): ${error.message}`);
        }
        await context.close();
      }
    for (const [how, options] of [["without script", { javaScriptEnabled: false }], ["in the dark", { colorScheme: "dark" }]])
      for (const role of ROLES) {
        where = `${role} ${how}`;
        const context = await browser.newContext({ viewport: WIDE, ...options });
        const page = await logIn(context, base, role);
        const links = await page.locator(options.colorScheme ? ".top a" : "nav a, main a").evaluateAll((all) => [...new Set(all.map((one) => one.pathname))]);
        for (const path of links.filter((one) => !one.includes(".") && one !== "/healthz")) {
          const answer = await page.goto(base + path);
          expect(answer.status() === 200, `${path} answers ${answer.status()}`);
          expect((await page.locator("main").innerText()).length > 40, `${path} says nothing`);
          if (options.colorScheme) await look(page, path.slice(1).replaceAll("/", "-") || "start");
        }
        await context.close();
      }
  } finally {
    await browser.close();
    server.kill();
  }
}

try {
  await main();
} catch (error) {
  report(`${where}: ${error.stack}`);
}
process.exitCode = faults.size > 0 ? 1 : 0;
