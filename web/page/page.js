// The page around the editor: its files in the browser's own store, files in and out, and what the page has to say.
"use strict";

const home = "/home/you"; // everything below is stored in the browser
const levels = home + "/levels";
const shipped = "/assets"; // levels that come with the page
const element = (id) => document.getElementById(id);

const embedded = window.top !== window; // a view in a page of the documents: no header, and nothing is stored

// --- what the page says

function say(text, bad = false) {
  element("note").textContent = element("note").title = text;
  element("note").classList.toggle("bad", bad);
}

function cover(text) {
  element("cover").style.display = text ? "" : "none";
  if (text) element("progress").textContent = text;
}

// --- the store: one record per file, in IndexedDB

const store = {
  database: null,
  stored: new Map(), // path -> "time size" of what the store holds
  shipped: new Map(), // the same of files that came with the page: they are stored only once they change
  writing: null,
  failed: false,

  async open() {
    if (embedded) return;
    // One tab writes. Two would each take the other's files for deleted ones.
    const alone = !navigator.locks || await new Promise((decided) => {
      navigator.locks.request("slipface " + location.pathname, { ifAvailable: true }, (lock) => {
        decided(lock !== null);
        return lock && new Promise(() => {}); // held until the tab is closed
      });
    });
    if (!alone) throw new Error("Slipface is open in another tab, which stores your work. This tab stores nothing: download what you want to keep.");
    this.database = await new Promise((done, fail) => {
      const request = indexedDB.open("slipface " + location.pathname, 1);
      request.onupgradeneeded = () => request.result.createObjectStore("files");
      request.onsuccess = () => done(request.result);
      request.onerror = () => fail(new Error("This browser stores nothing (" + request.error.message + "): download what you want to keep."));
    });
    if (navigator.storage && navigator.storage.persist) navigator.storage.persist();
  },

  async read() {
    if (!this.database) return;
    const files = this.database.transaction("files").objectStore("files");
    const all = (request) => new Promise((done, fail) => {
      request.onsuccess = () => done(request.result);
      request.onerror = () => fail(request.error);
    });
    const [paths, records] = await Promise.all([all(files.getAllKeys()), all(files.getAll())]);
    paths.forEach((path, i) => {
      write(path, records[i].bytes);
      FS.utime(path, records[i].time, records[i].time);
      this.stored.set(path, stamp(path));
    });
  },

  // Writes what has changed since the last call. Resolves when the browser has it on disk.
  async write() {
    if (!this.database) return;
    if (this.writing) await this.writing.catch(() => {});
    const changed = [], now = new Set();
    for (const path of walk(home)) {
      now.add(path);
      const seen = stamp(path);
      if (this.shipped.get(path) !== seen && this.stored.get(path) !== seen && !/\.tmp$/.test(path)) changed.push([path, seen]);
    }
    const gone = [...this.stored.keys()].filter((path) => !now.has(path));
    if (changed.length + gone.length === 0) return;
    this.writing = new Promise((done, fail) => {
      const transaction = this.database.transaction("files", "readwrite", { durability: "strict" });
      const files = transaction.objectStore("files");
      for (const [path] of changed) files.put({ time: FS.stat(path).mtime.getTime(), bytes: FS.readFile(path) }, path);
      for (const path of gone) files.delete(path);
      transaction.oncomplete = done;
      transaction.onerror = transaction.onabort = () => fail(transaction.error);
    });
    try {
      await this.writing;
      for (const [path, seen] of changed) this.stored.set(path, seen);
      for (const path of gone) this.stored.delete(path);
      if (this.failed) say("Everything is stored again");
      this.failed = false;
    } catch (error) {
      this.failed = true;
      const why = error && error.name === "QuotaExceededError" ? "the browser's store is full" : String(error && error.message);
      say("Your latest changes are NOT stored: " + why + ". Use Download… before you close this tab.", true);
    }
    this.writing = null;
  },
};

const stamp = (path) => { const is = FS.stat(path); return is.mtime.getTime() + " " + is.size; };

function* walk(folder) {
  for (const name of FS.readdir(folder)) {
    if (name === "." || name === "..") continue;
    const path = folder + "/" + name;
    if (FS.isDir(FS.stat(path).mode)) yield* walk(path);
    else yield path;
  }
}

function write(path, bytes) {
  FS.mkdirTree(path.slice(0, path.lastIndexOf("/")));
  FS.writeFile(path, bytes);
}

// --- files in

const is_level = (name) => /\.(obj|bsp)$/i.test(name);
const is_level_file = (name) => /\.slipface\.json$/i.test(name);

// The files of a drop, those in its folders too, with their paths below it.
async function dropped(items) {
  const found = [];
  const visit = async (entry, prefix) => {
    if (entry.isFile) {
      found.push([prefix + entry.name, await new Promise((done, fail) => entry.file(done, fail))]);
    } else {
      const reader = entry.createReader();
      for (;;) {
        const batch = await new Promise((done, fail) => reader.readEntries(done, fail));
        if (batch.length === 0) break;
        for (const each of batch) await visit(each, prefix + entry.name + "/");
      }
    }
  };
  const entries = [...items].filter((item) => item.kind === "file").map((item) => item.webkitGetAsEntry());
  for (const entry of entries) if (entry) await visit(entry, "");
  return found;
}

// Copies files into the page and opens the level among them. Without a level they go beside the open one, which notices.
async function add(files) {
  const main = files.find(([name]) => is_level(name)) || files.find(([name]) => is_level_file(name));
  const open = JSON.parse(state()).level;
  const stem = main ? main[0].split("/").pop().replace(/(\.slipface)?\.[^.]*$/, "") : "";
  const beside = open && (!main || is_level_file(main[0]));
  const folder = beside ? open.slice(0, open.lastIndexOf("/")) : levels + "/" + (stem || "files");
  for (const [name, file] of files) {
    const safe = name.split("/").filter((part) => part && part !== "." && part !== "..").join("/");
    write(folder + "/" + safe, new Uint8Array(await file.arrayBuffer()));
  }
  const count = files.length === 1 ? files[0][0] : files.length + " files";
  say("Added " + count + " to " + folder.replace(home, "~"));
  const link = files.find(([name]) => /\.link$/.test(name));
  if (link) open_file(folder + "/" + link[0]);
  else if (main && !beside) open_file(folder + "/" + main[0]);
  store.write();
}

// --- files out

function download(path) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([FS.readFile(path)]));
  link.download = path.split("/").pop();
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

function list_files() {
  const list = element("files").querySelector("ul");
  list.replaceChildren();
  const paths = [...walk(home)].filter((path) => !/\/\.(config|state)\//.test(path));
  const as_it_came = (path) => store.shipped.get(path) === stamp(path);
  paths.sort((a, b) => as_it_came(a) - as_it_came(b) || FS.stat(b).mtime - FS.stat(a).mtime);
  for (const path of paths) {
    const link = document.createElement("a");
    link.href = "#";
    link.textContent = path.replace(home + "/", "") + (store.shipped.has(path) && !as_it_came(path) ? " (changed here)" : "");
    link.onclick = (event) => { event.preventDefault(); download(path); };
    const item = document.createElement("li");
    item.append(link);
    list.append(item);
  }
  element("files").showModal();
}

// --- calls into the editor

const state = () => ccall("slipface_state", "string", [], []);
const open_file = (path) => ccall("slipface_open", null, ["string"], [path]);

function follow(link) {
  const problem = ccall("slipface_open_link", "string", ["string"], [link]);
  if (problem) say(problem, true);
}

// The switch of a demo's hack, to press beside its run, which is shown over and over.
function show_switch(demo) {
  ccall("slipface_loop", null, [], []);
  const button = document.createElement("button");
  const current = () => ccall("slipface_switch", "string", ["string"], [demo]);
  if (!current()) return;
  const label = () => { button.textContent = current().replace("=", ": ").replace(/_/g, " "); };
  button.onclick = () => {
    const [name, value] = current().split("=");
    ccall("slipface_set", null, ["string"], [name + "=" + (value === "on" ? "off" : "on")]);
    label();
  };
  label();
  button.id = "switch";
  document.body.append(button);
}

// Messages, because a browser delays timers, in hidden tabs by a second.
const turns = [], channel = new MessageChannel();
channel.port1.onmessage = () => turns.shift()();

// What the editor calls.
const Slipface = {
  // Threads as calls that are suspended (one_thread.cpp), if the browser can.
  suspends: typeof WebAssembly.Suspending === "function" && typeof WebAssembly.promising === "function",
  begin_call(call) { WebAssembly.promising(Module.asm.slipface_call)(call).catch((error) => keep_after_failure(error.message)); },
  turn() { return new Promise((done) => { turns.push(done); channel.port2.postMessage(null); }); },
  copy(text) { navigator.clipboard.writeText(text).catch(() => say("The browser does not let this page copy", true)); },
  // In the documents as a site this page lies beside them.
  read(title) { open("../docs/symptoms.html#" + title.toLowerCase().replace(/[^a-z0-9 -]/g, "").replace(/ /g, "-"), "_blank"); },
  shown() {
    cover("");
    performance.mark("slipface first picture");
    element("canvas").focus();
    if (location.hash.length > 1) follow(location.hash);
    const demo = location.hash.match(/[#&]demo=([^&]*)/);
    if (embedded && demo && JSON.parse(state()).tick !== undefined) show_switch(demo[1]);
    const going_on = !embedded && sessionStorage.getItem("go on");
    sessionStorage.removeItem("go on");
    if (going_on) open_file(going_on);
  },
  ended() { store.write().then(() => cover("Slipface has ended. Reload the page to start it again.")); },
};

// --- start

async function start() {
  document.body.classList.toggle("embedded", embedded);
  FS.mkdirTree(levels);
  // So that the editor finds what comes with it (data_folder).
  FS.symlink(home + "/slipface", "/proc/self/exe");
  for (const path of walk(shipped)) {
    const copy = home + path;
    write(copy, FS.readFile(path));
    store.shipped.set(copy, stamp(copy));
  }
  try {
    await store.open();
    await store.read();
  } catch (error) {
    say(error.message, true);
  }
  const problem = ccall("slipface_start", "string", ["string", "number"], [embedded ? "" : home, devicePixelRatio]);
  if (problem) return cover("Slipface cannot draw here: " + problem);
  setInterval(() => store.write(), 1000);
}

// The page may be closed, or the graphics be gone, without another word: what is not saved goes into an autosave first.
function keep() {
  if (!Module.calledRun) return Promise.resolve();
  ccall("slipface_autosave", null, [], []);
  return store.write();
}

var Module = {
  canvas: element("canvas"),
  setStatus(text) { const part = text.match(/\((\d+)\/(\d+)\)/); if (part) cover("Loading… " + Math.round((100 * part[1]) / part[2]) + " %"); },
  instantiateWasm(imports, receive) {
    if (Slipface.suspends) imports.env.page_turn = new WebAssembly.Suspending(imports.env.page_turn);
    const read = async () => {
      const response = await fetch("slipface.wasm");
      if (!response.ok) throw new Error("slipface.wasm: " + response.status);
      return WebAssembly.instantiate(await response.arrayBuffer(), imports);
    };
    WebAssembly.instantiateStreaming(fetch("slipface.wasm"), imports).catch(read) // a server may not know its type
      .then(({ instance, module }) => receive(instance, module), (error) => cover("Slipface could not be loaded: " + error.message));
    return {};
  },
  onRuntimeInitialized() { start().catch((error) => cover("Slipface could not start: " + error.message)); },
  onAbort(what) {
    keep_after_failure(what);
  },
};

function keep_after_failure(what) {
  store.write().finally(() => cover("Slipface has stopped: " + what + "\nReload the page; the last autosave is offered there."));
}

addEventListener("error", (event) => { if (/wasm|RuntimeError|out of memory|abort/i.test(String(event.error || event.message))) keep_after_failure(event.message); });
addEventListener("visibilitychange", () => { if (document.visibilityState === "hidden") keep(); });
addEventListener("pagehide", () => { keep(); });
addEventListener("beforeunload", (event) => {
  if (!Module.calledRun || leaving) return;
  keep();
  if (ccall("slipface_unsaved", "number", [], []) || store.failed) event.preventDefault();
});
addEventListener("paste", (event) => ccall("slipface_pasted", null, ["string"], [event.clipboardData.getData("text/plain")]));
addEventListener("hashchange", () => { if (location.hash.length > 1) follow(location.hash); });
addEventListener("contextmenu", (event) => { if (event.target === element("canvas")) event.preventDefault(); });
addEventListener("dragover", (event) => { event.preventDefault(); document.body.classList.add("dropping"); });
addEventListener("dragleave", () => document.body.classList.remove("dropping"));
addEventListener("drop", async (event) => {
  event.preventDefault();
  document.body.classList.remove("dropping");
  const files = await dropped(event.dataTransfer.items);
  if (files.length > 0) await add(files);
});
// When the browser gives the graphics back, the page begins anew with the level that was open, and offers the autosave.
let leaving = false, kept = null;
element("canvas").addEventListener("webglcontextlost", (event) => {
  event.preventDefault();
  sessionStorage.setItem("go on", JSON.parse(state()).level || "");
  kept = keep();
  kept.then(() => cover(store.database && !store.failed
    ? "The browser has taken the graphics from this page.\nWhat was not saved is stored as an autosave. Reload the page to go on with it."
    : "The browser has taken the graphics from this page, and your changes are NOT stored.\nPress Ctrl+S, then use Download… before you reload the page."));
});
element("canvas").addEventListener("webglcontextrestored", async () => {
  await kept;
  if (!embedded && (store.failed || !store.database) && ccall("slipface_unsaved", "number", [], [])) return;
  leaving = true;
  location.reload();
});
element("add").onclick = () => element("picker").click();
element("picker").onchange = (event) => {
  const files = [...event.target.files].map((file) => [file.name, file]);
  event.target.value = "";
  if (files.length > 0) add(files);
};
element("take").onclick = list_files;
element("link").onclick = () => {
  const link = ccall("slipface_link", "string", [], []);
  if (!link) return say("There is no run to link to: play, or open a tape or a demo", true);
  history.replaceState(null, "", "#" + link);
  navigator.clipboard.writeText(location.href).then(
    () => say("Copied the address, " + location.href.length + " characters"),
    () => say("The address of this page is now that of the run"));
};
for (const button of document.querySelectorAll("header button")) button.addEventListener("mousedown", (event) => event.preventDefault());
