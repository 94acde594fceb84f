// A server of static files, a headless Chromium, and a person's hands in the page. scripts/check_web.sh uses them.
import { createServer } from "node:http";
import { createReadStream, existsSync, mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { extname, join } from "node:path";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";

const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".svg": "image/svg+xml", ".mjs": "text/javascript" };
export function serve(folder) {
  const server = createServer((request, response) => {
    const path = join(folder, new URL(request.url, "http://x").pathname.replace(/\/$/, "/index.html"));
    if (!existsSync(path)) return response.writeHead(404).end();
    response.writeHead(200, { "Content-Type": types[extname(path)] || "application/octet-stream" });
    createReadStream(path).pipe(response);
  }).listen(0);
  return { address: `http://localhost:${server.address().port}/`, close: () => server.close() };
}

export const options = {
  executablePath: "/usr/bin/chromium", headless: true, viewport: { width: 1280, height: 800 },
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
};

// The checks' state: what failed, and what the console said.
export function begin(modules, pictures) {
  mkdirSync(pictures, { recursive: true });
  const profile = mkdtempSync(join(tmpdir(), "slipface-web-"));
  const self = {
    chromium: createRequire(join(modules, "x.js"))("playwright-core").chromium,
    profile, failures: 0, said: [],
    check(name, holds, found) {
      console.log(`${holds ? "ok  " : "FAIL"} ${name}${holds || found === undefined ? "" : ": found " + JSON.stringify(found)}`);
      if (!holds) self.failures += 1;
      return holds;
    },
    watch(page) {
      page.on("console", (message) => { if (["error", "warning"].includes(message.type())) self.said.push(message.text()); });
      page.on("pageerror", (error) => self.said.push(String(error)));
      page.on("dialog", (dialog) => dialog.accept());
    },
    end() {
      const known = /favicon|GPU stall|GroupMarkerNotSet|software WebGL|beforeunload|CONTEXT_LOST_WEBGL|WebGL: context lost/;
      const errors = self.said.filter((text) => !known.test(text));
      self.check("nothing on the console", errors.length === 0, errors.slice(0, 5));
      rmSync(profile, { recursive: true, force: true });
      console.log(self.failures === 0 ? "all as it should be" : self.failures + " failures");
      return self.failures === 0 ? 0 : 1;
    },
  };
  return self;
}

// What a person does in a page, or in a frame of one. `view`: the page or frame; `page`: whose mouse and keys are used.
export function hands(checks, page, pictures, view = page) {
  const self = {
    page,
    state: () => view.evaluate(() => JSON.parse(state())),
    note: () => view.textContent("#note"),
    wait: (ms) => page.waitForTimeout(ms),
    async until(name, holds, seconds = 60) {
      const end = Date.now() + 1000 * seconds;
      let found;
      while (Date.now() < end) {
        found = await self.state();
        if (await holds(found)) return checks.check(name, true), found;
        await page.waitForTimeout(100);
      }
      checks.check(name, false, found);
      return found;
    },
    async place(path) {
      for (let tries = 0; tries < 100; ++tries) {
        const box = await view.evaluate((name) => {
          const text = ccall("slipface_widget", "string", ["string"], [name]);
          const canvas = document.getElementById("canvas").getBoundingClientRect();
          const [x, y, width, height] = text.split(" ").map((value) => value / devicePixelRatio);
          return text && { x: x + canvas.left, y: y + canvas.top, width, height };
        }, path);
        if (box) {
          if (view === page) return box;
          const frame = await (await view.frameElement()).boundingBox();
          return { ...box, x: box.x + frame.x, y: box.y + frame.y };
        }
        await page.waitForTimeout(100);
      }
      checks.check("there is a widget " + path, false);
      throw new Error("no widget " + path);
    },
    async click(path) {
      const box = await self.place(path);
      await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
      await page.waitForTimeout(200);
    },
    // A stroke in the view, in parts of its size.
    async drag(from, to) {
      const area = await self.place("Viewport/View");
      const at = ([x, y]) => [area.x + x * area.width, area.y + y * area.height];
      await page.mouse.move(...at(from));
      await page.waitForTimeout(300);
      await page.mouse.down();
      for (let i = 1; i <= 10; ++i) {
        await page.mouse.move(...at([from[0] + (to[0] - from[0]) * i / 10, from[1] + (to[1] - from[1]) * i / 10]));
        await page.waitForTimeout(60);
      }
      await page.mouse.up();
      await page.waitForTimeout(300);
    },
    async picture(name) {
      await page.waitForTimeout(600);
      await page.screenshot({ path: join(pictures, name + ".png") });
    },
    async ready() {
      await view.waitForFunction(() => performance.getEntriesByName("slipface first picture").length > 0, null, { timeout: 180000 });
      return view.evaluate(() => performance.getEntriesByName("slipface first picture")[0].startTime);
    },
    async go(address) {
      await page.goto("about:blank");
      await page.goto(address);
      return self.ready();
    },
    async reload() {
      await page.reload();
      return self.ready();
    },
    async open(level) {
      await self.click("Welcome/Samples/" + level);
      return self.until("the level " + level + " opens", (is) => is.level && is.level.endsWith(`/${level}.obj`));
    },
    async paint() {
      await page.keyboard.press("2");
      await page.keyboard.press("b");
      await self.drag([0.42, 0.6], [0.58, 0.62]);
    },
    stored: () => view.evaluate(() => store.write()),
  };
  return self;
}
