// The mover for JavaScript: slipface.h, compiled to WebAssembly, behind classes. index.d.ts describes what is exported.
let wasm = null; // the exports
let at = null; // "player.position" -> bytes
let view = null; // of the memory; it is made anew when the memory has grown
let scratch = null; // addresses of structs that live as long as the module

const NONE = 0xffffffff;
const CONTACT_ROOM = 16;
const EVENT_ROOM = 16;

export class SlipfaceError extends Error {
    constructor(message) {
        super(message);
        this.name = "SlipfaceError";
    }
}

export const Button = Object.freeze({ jump: 1, crouch: 2, dash: 4, grab: 8, drop: 16 });
const eventKinds = ["landed", "left", "touched", "hazard", "stepped", "crushed", "entered", "stayed", "departed"];
const passes = ["slide", "horizontal", "vertical", "push", "step up", "snap"];
const settingKinds = ["switch", "whole", "number", "choice"];

function memory() {
    if (view.buffer !== wasm.memory.buffer) view = new DataView(wasm.memory.buffer);
    return view;
}
function need() {
    if (wasm === null) throw new SlipfaceError("slipface is not loaded: await load() first");
    if (asking) throw new SlipfaceError("the function of a filter called slipface, which waits for its answer");
}
function text(address) {
    const bytes = new Uint8Array(memory().buffer, address);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
}
function check(status) {
    if (status !== 0) throw new SlipfaceError(text(scratch.error + at["error.text"]));
}
const number = (value) => (typeof value === "number" ? value : NaN); // so that the library names it
function set_vec(address, v, what) {
    if (v === null || typeof v !== "object") throw new SlipfaceError(`${what}: found ${v}, expected {x, y, z}`);
    const m = memory();
    m.setFloat64(address, number(v.x), true);
    m.setFloat64(address + 8, number(v.y), true);
    m.setFloat64(address + 16, number(v.z), true);
}
function vec(address, m = memory()) {
    return { x: m.getFloat64(address, true), y: m.getFloat64(address + 8, true), z: m.getFloat64(address + 16, true) };
}
const id_or_null = (value) => (value === NONE ? null : value);
function allocate(bytes) {
    const address = wasm.malloc(bytes);
    if (address === 0) throw new SlipfaceError(`out of memory: ${bytes} bytes`);
    new Uint8Array(wasm.memory.buffer, address, bytes).fill(0);
    return address;
}
// Runs `use` with zeroed bytes that are freed afterwards.
function with_bytes(bytes, use) {
    const address = allocate(Math.max(bytes, 1));
    try {
        return use(address);
    } finally {
        wasm.free(address);
    }
}
function with_string(string, use) {
    const bytes = new TextEncoder().encode(String(string));
    return with_bytes(bytes.length + 1, (address) => {
        new Uint8Array(wasm.memory.buffer, address, bytes.length).set(bytes);
        return use(address);
    });
}
function natural(value, what) {
    if (!Number.isInteger(value) || value < 0 || value > NONE)
        throw new SlipfaceError(`${what}: found ${value}, expected a whole number from 0`);
    return value;
}

// The functions of the filters of the call that runs. While one of them runs nothing else does: the call holds its arguments in
// the memory. What it throws is thrown when the call has returned.
const asked = [];
let thrown = null, asking = false;
function ask(which, platform, triangle) {
    if (thrown !== null) return 1;
    asking = true;
    try {
        return asked[which](id_or_null(platform >>> 0), triangle >>> 0) ? 1 : 0;
    } catch (error) {
        thrown = { error };
        return 1;
    } finally {
        asking = false;
    }
}
const imports = { slipface: { sees: ask }, env: { emscripten_notify_memory_growth: () => {} } };
// What C and C++ may ask of a system; there is none.
function complete(module) {
    const all = { ...imports };
    const not_there = 52; // ENOSYS of WASI
    for (const { module: from, name } of WebAssembly.Module.imports(module))
        all[from] = { [name]: () => not_there, ...all[from] };
    return all;
}

let loading = null;
export function load(source) {
    loading ??= start(source).catch((error) => {
        loading = null;
        throw error;
    });
    return loading;
}

async function compile(source) {
    const from = (await source) ?? new URL("./mover.wasm", import.meta.url);
    if (from instanceof WebAssembly.Module) return from;
    if (from instanceof ArrayBuffer || ArrayBuffer.isView(from)) return WebAssembly.compile(from);
    if (from instanceof Response) return WebAssembly.compile(await from.arrayBuffer());
    if (typeof from !== "string" && !(from instanceof URL))
        throw new SlipfaceError(`load: found ${from}, expected an address, a Response, bytes or a WebAssembly.Module`);
    const url = new URL(from, import.meta.url);
    if (url.protocol === "file:") {
        const { readFile } = await import(/* webpackIgnore: true */ /* @vite-ignore */ "node:fs/promises");
        return WebAssembly.compile(await readFile(url));
    }
    const answer = await fetch(url);
    if (!answer.ok) throw new SlipfaceError(`${url}: found HTTP status ${answer.status}, expected mover.wasm`);
    return WebAssembly.compile(await answer.arrayBuffer());
}

async function start(source) {
    const module = await compile(source);
    const instance = await WebAssembly.instantiate(module, complete(module));
    wasm = instance.exports;
    view = new DataView(wasm.memory.buffer);
    wasm._initialize?.();
    at = {};
    for (let row = wasm.slipface_js_layout(); memory().getUint32(row, true) !== 0; row += 8)
        at[text(memory().getUint32(row, true))] = memory().getUint32(row + 4, true);
    scratch = {};
    for (const name of ["error", "sweep", "contact", "ray_hit", "closest", "input", "setting", "triangles"])
        scratch[name] = allocate(at[name]);
    for (const name of ["a", "b", "c"]) scratch[name] = allocate(32);
    memory().setUint32(scratch.input, at.input, true);
    memory().setUint32(scratch.triangles, at.triangles, true);
}

// What the garbage collector finds is freed; dispose() frees at once.
const forgotten = new FinalizationRegistry((free) => free());
class Held {
    #free;
    constructor(free) {
        this.#free = free;
        forgotten.register(this, free, this);
    }
    get disposed() {
        return this.#free === null;
    }
    dispose() {
        if (this.#free === null) return;
        forgotten.unregister(this);
        const free = this.#free;
        this.#free = null;
        free();
    }
}
if (Symbol.dispose)
    Object.defineProperty(Held.prototype, Symbol.dispose, { value() { this.dispose(); }, configurable: true });

function kind_of(object, type, what) {
    if (!(object instanceof type)) throw new SlipfaceError(`${what}: found ${object}, expected a ${type.name}`);
    need();
    if (object.disposed) throw new SlipfaceError(`${what}: this ${type.name} was disposed of`);
    return object;
}

export class Settings extends Held {
    constructor(preset, changes) {
        need();
        if (typeof preset === "object" && preset !== null) [preset, changes] = [undefined, preset];
        const handle = preset === undefined || preset === null
            ? (check(wasm.slipface_settings_new(0, scratch.a, scratch.error)), memory().getBigUint64(scratch.a, true))
            : with_string(preset, (name) => {
                check(wasm.slipface_settings_new(name, scratch.a, scratch.error));
                return memory().getBigUint64(scratch.a, true);
            });
        super(() => wasm.slipface_settings_free(handle, 0));
        this.handle = handle;
        for (const [name, value] of Object.entries(changes ?? {})) this.set(name, value);
    }
    set(name, value) {
        kind_of(this, Settings, "set");
        if (typeof value === "string") {
            with_string(`${name}=${value}`, (one) => check(wasm.slipface_settings_set(this.handle, one, scratch.error)));
        } else {
            const which = setting_number(name);
            check(wasm.slipface_settings_set_number(this.handle, which, number(typeof value === "boolean" ? +value : value), scratch.error));
        }
        return this;
    }
    get(name) {
        kind_of(this, Settings, "get");
        check(wasm.slipface_settings_get_number(this.handle, setting_number(name), scratch.a, scratch.error));
        return memory().getFloat64(scratch.a, true);
    }
    get radii() {
        return { x: this.get("radius_x"), y: this.get("radius_y"), z: this.get("radius_z") };
    }
    static list() {
        need();
        return Array.from({ length: wasm.slipface_setting_count() }, (_, i) => {
            check(wasm.slipface_setting_at(i, scratch.setting, scratch.error));
            const m = memory(), from = scratch.setting;
            const word = (member) => text(m.getUint32(from + at[`setting.${member}`], true));
            const value = (member) => m.getFloat64(from + at[`setting.${member}`], true);
            return {
                name: word("name"), label: word("label"), group: word("group"), unit: word("unit"), meaning: word("meaning"),
                minimum: value("minimum"), maximum: value("maximum"), initial: value("initial"),
                kind: settingKinds[m.getUint32(from + at["setting.kind"], true)],
            };
        });
    }
}
const numbers = new Map();
function setting_number(name) {
    if (!numbers.has(name))
        numbers.set(name, with_string(name, (one) => {
            check(wasm.slipface_setting_find(one, scratch.a, scratch.error));
            return memory().getUint32(scratch.a, true);
        }));
    return numbers.get(name);
}

// Typed arrays as slipface_triangles, for as long as `use` runs.
function with_triangles(mesh, use) {
    const positions = typed(mesh.positions, Float32Array, "positions", 3);
    const indices = mesh.indices === undefined || mesh.indices === null
        ? Uint32Array.from({ length: positions.length / 3 }, (_, i) => i)
        : mesh.indices instanceof Uint16Array ? Uint32Array.from(mesh.indices) : typed(mesh.indices, Uint32Array, "indices", 3);
    if (indices.length % 3 !== 0) throw new SlipfaceError(`indices: found ${indices.length}, expected three per triangle`);
    const count = indices.length / 3;
    const of_each = (array, Kind, what) => {
        if (array === undefined || array === null) return null;
        if (typed(array, Kind, what, 1).length !== count)
            throw new SlipfaceError(`${what}: found ${array.length}, expected one of each of ${count} triangles`);
        return array;
    };
    const types = of_each(mesh.types, Uint8Array, "types"), groups = of_each(mesh.groups, Uint32Array, "groups");
    const places = [positions, indices, groups, types];
    const total = places.reduce((sum, array) => sum + (array === null ? 0 : array.byteLength), 0);
    return with_bytes(total, (address) => {
        let next = address;
        const given = places.map((array) => {
            if (array === null) return 0;
            new array.constructor(wasm.memory.buffer, next, array.length).set(array);
            next += array.byteLength;
            return next - array.byteLength;
        });
        const m = memory(), to = scratch.triangles;
        const put = (member, value) => m.setUint32(to + at[`triangles.${member}`], value, true);
        put("positions", given[0]), put("position_count", positions.length / 3);
        put("indices", given[1]), put("triangle_count", count);
        put("groups", given[2]), put("types", given[3]);
        return use(to);
    });
}
function typed(array, Kind, what, multiple) {
    if (!(array instanceof Kind)) throw new SlipfaceError(`${what}: found ${array?.constructor?.name ?? array}, expected a ${Kind.name}`);
    if (array.length % multiple !== 0) throw new SlipfaceError(`${what}: found ${array.length} numbers, expected a multiple of ${multiple}`);
    return array;
}

// Filters as the library reads them, one after the other, and their ignored types behind them.
const bits = (value, what) => natural(Number.isInteger(value) && value < 0 ? value >>> 0 : value, what);
function with_filters(filters, use) {
    if (filters.every((filter) => filter === undefined || filter === null)) return use(0);
    const first = asked.length;
    try {
        return with_bytes(filters.length * (at.filter + 256), (address) => {
            const m = memory();
            filters.forEach((filter, i) => {
                const one = address + i * at.filter, types_at = address + filters.length * at.filter + i * 256;
                const { mask = NONE, groups = NONE, ignoredTypes = [], sees } = filter ?? {};
                const types = Uint8Array.from(new Set(ignoredTypes), (type) => {
                    if (natural(type, "ignoredTypes") > 255) throw new SlipfaceError(`ignoredTypes: found ${type}, expected a type`);
                    return type;
                });
                new Uint8Array(m.buffer, types_at, types.length).set(types);
                m.setUint32(one, at.filter, true);
                m.setUint32(one + at["filter.mask"], bits(mask, "mask"), true);
                m.setUint32(one + at["filter.groups"], bits(groups, "groups"), true);
                m.setUint32(one + at["filter.ignored_types"], types_at, true);
                m.setUint32(one + at["filter.ignored_type_count"], types.length, true);
                if (sees === undefined) return;
                if (typeof sees !== "function") throw new SlipfaceError(`sees: found ${sees}, expected a function`);
                wasm.slipface_js_ask(one, asked.push(sees) - 1);
            });
            const result = use(address);
            if (thrown !== null) throw thrown.error;
            return result;
        });
    } finally {
        asked.length = first;
        thrown = null;
    }
}

function contact_at(address) {
    const m = memory(), get = (member) => m.getUint32(address + at[`contact.${member}`], true);
    return {
        t: m.getFloat64(address + at["contact.t"], true),
        point: vec(address + at["contact.point"], m),
        normal: vec(address + at["contact.normal"], m),
        triangle: id_or_null(get("triangle")), face: id_or_null(get("face")), type: get("type"),
        platform: id_or_null(get("platform")), feature: ["interior", "edge", "vertex"][get("feature")],
    };
}

// Of a mesh, or of three.js's BufferGeometry or Babylon's VertexData, known by what they have, so that neither is imported.
function mesh_of(mesh, matrix) {
    const attribute = mesh?.attributes?.position, from = mesh?.positions;
    if (attribute === undefined && from === undefined) throw new SlipfaceError("geometry: found neither attributes.position nor positions");
    if (attribute === undefined && matrix === undefined && from instanceof Float32Array) return mesh;
    const count = attribute === undefined ? from.length / 3 : attribute.count;
    const corner = attribute === undefined ? (i) => [from[3 * i], from[3 * i + 1], from[3 * i + 2]]
        : (i) => [attribute.getX(i), attribute.getY(i), attribute.getZ(i)];
    const e = matrix?.elements ?? matrix ?? [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
    const positions = new Float32Array(3 * count);
    for (let i = 0; i < count; ++i) {
        const [x, y, z] = corner(i);
        for (let k = 0; k < 3; ++k) positions[3 * i + k] = e[k] * x + e[4 + k] * y + e[8 + k] * z + e[12 + k];
    }
    const index = mesh.index?.array ?? mesh.indices;
    const indices = index ? Uint32Array.from(index) : Uint32Array.from({ length: count }, (_, i) => i);
    // A matrix that mirrors turns triangles inside out; they are turned back.
    const mirrors = e[0] * (e[5] * e[10] - e[6] * e[9]) - e[4] * (e[1] * e[10] - e[2] * e[9]) + e[8] * (e[1] * e[6] - e[2] * e[5]) < 0;
    for (let i = 0; mirrors && i < indices.length; i += 3) [indices[i + 1], indices[i + 2]] = [indices[i + 2], indices[i + 1]];
    // A BufferGeometry's own groups are ranges of materials.
    return attribute === undefined ? { positions, indices, types: mesh.types, groups: mesh.groups } : { positions, indices };
}

// Several meshes as one, each triangle with its mesh's type and groups.
function shape_of(mesh) {
    const { positions, indices } = mesh_of(mesh.geometry ?? mesh, mesh.matrix);
    return { positions, indices: indices ?? Uint32Array.from({ length: positions.length / 3 }, (_, i) => i) };
}
export function merge(meshes) {
    const parts = meshes.map((mesh) => ({ type: mesh.type ?? 0, groups: (mesh.attributes === undefined ? mesh.groups : undefined) ?? NONE, ...shape_of(mesh) }));
    const sum = (length) => parts.reduce((total, part) => total + length(part), 0);
    const positions = new Float32Array(sum((part) => part.positions.length));
    const indices = new Uint32Array(sum((part) => part.indices.length));
    const types = new Uint8Array(indices.length / 3), groups = new Uint32Array(indices.length / 3);
    let corner = 0, index = 0;
    for (const part of parts) {
        positions.set(part.positions, corner);
        indices.set(part.indices.map((i) => i + corner / 3), index);
        if (natural(part.type, "type") > 255) throw new SlipfaceError(`type: found ${part.type}, expected a type`);
        types.fill(part.type, index / 3, (index + part.indices.length) / 3);
        groups.fill(bits(part.groups, "groups"), index / 3, (index + part.indices.length) / 3);
        corner += part.positions.length;
        index += part.indices.length;
    }
    return { positions, indices, types, groups };
}

export class World extends Held {
    constructor(mesh) {
        need();
        const handle = with_triangles(mesh_of(mesh), (triangles) => {
            check(wasm.slipface_world_from_triangles(triangles, scratch.a, scratch.error));
            return memory().getBigUint64(scratch.a, true);
        });
        super(() => wasm.slipface_world_free(handle, 0));
        this.handle = handle;
    }
    static fromGeometry(geometry, options = {}) {
        return new World(merge([{ geometry, ...options }]));
    }
    get bounds() {
        kind_of(this, World, "bounds");
        check(wasm.slipface_world_bounds(this.handle, scratch.a, scratch.b, scratch.c, scratch.error));
        return { lowest: vec(scratch.a), highest: vec(scratch.b), triangles: memory().getUint32(scratch.c, true) };
    }

    type(name) {
        kind_of(this, World, "type");
        return with_string(name, (one) => {
            check(wasm.slipface_world_find_type(this.handle, one, scratch.a, scratch.error));
            return id_or_null(memory().getUint32(scratch.a, true));
        });
    }
    addType(name, parameters = {}) {
        kind_of(this, World, "addType");
        const type = with_string(name, (one) => {
            check(wasm.slipface_world_add_type(this.handle, one, scratch.a, scratch.error));
            return memory().getUint32(scratch.a, true);
        });
        this.setType(type, parameters);
        return type;
    }
    setType(type, parameters) {
        kind_of(this, World, "setType");
        for (const [name, value] of Object.entries(parameters)) {
            const is_vector = value !== null && typeof value === "object";
            if (is_vector) set_vec(scratch.b, value, name);
            else memory().setFloat64(scratch.b, number(typeof value === "boolean" ? +value : value), true);
            with_string(name, (one) => check(wasm.slipface_world_set_type(
                this.handle, natural(type, "type"), one, scratch.b, is_vector ? 3 : 1, scratch.error)));
        }
    }
    setFaceType(face, type) {
        kind_of(this, World, "setFaceType");
        check(wasm.slipface_world_set_face_type(this.handle, natural(face, "face"), natural(type, "type"), scratch.error));
    }
    setFaceGroups(face, groups, platform = null) {
        kind_of(this, World, "setFaceGroups");
        check(wasm.slipface_world_set_face_groups(
            this.handle, platform === null ? NONE : natural(platform, "platform"), natural(face, "face"),
            bits(groups, "groups"), scratch.error));
    }

    addPlatform(mesh, matrix = undefined) {
        kind_of(this, World, "addPlatform");
        return with_triangles(mesh_of(mesh, matrix), (triangles) => {
            check(wasm.slipface_world_add_platform(this.handle, triangles, scratch.a, scratch.error));
            return memory().getUint32(scratch.a, true);
        });
    }
    movePlatform(platform, position, rotation, dt) {
        kind_of(this, World, "movePlatform");
        set_vec(scratch.a, position, "position");
        let turned = 0;
        if (rotation !== null && rotation !== undefined) {
            set_vec(scratch.b, rotation, "rotation");
            memory().setFloat64(scratch.b + 24, number(rotation.w), true);
            turned = scratch.b;
        }
        check(wasm.slipface_world_move_platform(this.handle, natural(platform, "platform"), scratch.a, turned, number(dt), scratch.error));
    }

    sweep(radii, from, move, filter) {
        kind_of(this, World, "sweep");
        set_vec(scratch.sweep, radii, "radii"), set_vec(scratch.sweep + 24, from, "from"), set_vec(scratch.sweep + 48, move, "move");
        return with_filters([filter], (seen) => {
            check(wasm.slipface_sweep_one(this.handle, scratch.sweep, seen, scratch.contact, scratch.error));
            const contact = contact_at(scratch.contact);
            return contact.t > 1 ? null : contact;
        });
    }
    ray(origin, direction, maxT = Infinity, filter = undefined) {
        kind_of(this, World, "ray");
        set_vec(scratch.a, origin, "origin"), set_vec(scratch.b, direction, "direction");
        return with_filters([filter], (seen) => {
            check(wasm.slipface_ray(this.handle, scratch.a, scratch.b, number(maxT), seen, scratch.ray_hit, scratch.error));
            const m = memory(), hit = scratch.ray_hit, get = (member) => m.getUint32(hit + at[`ray_hit.${member}`], true);
            const t = m.getFloat64(hit + at["ray_hit.t"], true);
            return t < 0 ? null : {
                t, point: vec(hit + at["ray_hit.point"], m), normal: vec(hit + at["ray_hit.normal"], m), triangle: get("triangle"),
                face: get("face"), platform: id_or_null(get("platform")), back: get("back") === 1,
            };
        });
    }
    closestPoint(point, maxDistance = Infinity, filter = undefined) {
        kind_of(this, World, "closestPoint");
        set_vec(scratch.a, point, "point");
        return with_filters([filter], (seen) => {
            check(wasm.slipface_closest_point(this.handle, scratch.a, number(maxDistance), seen, scratch.closest, scratch.error));
            const m = memory(), one = scratch.closest, get = (member) => m.getUint32(one + at[`closest.${member}`], true);
            const distance = m.getFloat64(one + at["closest.distance"], true);
            return distance < 0 ? null : {
                distance, point: vec(one + at["closest.point"], m), triangle: get("triangle"), face: get("face"),
                platform: id_or_null(get("platform")),
            };
        });
    }
    overlaps(radii, centre, filter) {
        kind_of(this, World, "overlaps");
        const room = 64;
        set_vec(scratch.a, radii, "radii"), set_vec(scratch.b, centre, "centre");
        return with_filters([filter], (seen) => with_bytes(room * at.overlap, (out) => {
            check(wasm.slipface_overlaps(this.handle, scratch.a, scratch.b, seen, out, room, scratch.c, scratch.error));
            const m = memory();
            return Array.from({ length: Math.min(room, m.getUint32(scratch.c, true)) }, (_, i) => {
                const one = out + i * at.overlap, get = (member) => m.getUint32(one + at[`overlap.${member}`], true);
                return {
                    point: vec(one + at["overlap.point"], m), normal: vec(one + at["overlap.normal"], m),
                    depth: m.getFloat64(one + at["overlap.depth"], true), triangle: get("triangle"), face: get("face"),
                    type: get("type"), platform: id_or_null(get("platform")),
                };
            });
        }));
    }
}

function set_input(address, input) {
    const m = memory(), { x = 0, z = 0, jump = false, buttons = 0 } = input ?? {};
    m.setUint32(address, at.input, true);
    m.setUint32(address + at["input.buttons"], ((buttons >>> 0) | (jump ? Button.jump : 0)) >>> 0, true);
    m.setFloat64(address + at["input.wish_x"], number(x), true);
    m.setFloat64(address + at["input.wish_z"], number(z), true);
}

export class Character extends Held {
    constructor(world, settings, position) {
        need();
        kind_of(world, World, "world"), kind_of(settings, Settings, "settings");
        set_vec(scratch.a, position, "position");
        // The player, then its report, and what that points to.
        const own = allocate(at.player + at.report + CONTACT_ROOM * at.contact + EVENT_ROOM * at.event + 8);
        super(() => wasm.free(own));
        try {
            check(wasm.slipface_player_at(world.handle, scratch.a, own, scratch.error));
        } catch (error) {
            this.dispose();
            throw error;
        }
        const report = own + at.player, contacts = report + at.report + (report + at.report) % 8;
        const events = contacts + CONTACT_ROOM * at.contact, m = memory();
        m.setUint32(report, at.report, true);
        m.setUint32(report + at["report.contact_room"], CONTACT_ROOM, true);
        m.setUint32(report + at["report.contacts"], contacts, true);
        m.setUint32(report + at["report.events"], events, true);
        m.setUint32(report + at["report.event_room"], EVENT_ROOM, true);
        Object.assign(this, { world, settings, own, report, contacts_at: contacts, events_at: events });
        this.filter = undefined;
    }
    step(input, dt) {
        kind_of(this, Character, "step"), kind_of(this.world, World, "world"), kind_of(this.settings, Settings, "settings");
        set_input(scratch.input, input);
        const run = (seen) => check(wasm.slipface_step(
            this.world.handle, this.settings.handle, this.own, scratch.input, number(dt), seen, this.report, this.own, scratch.error));
        if (this.filter === undefined) run(0);
        else with_filters([this.filter], run);
        return this;
    }
    #at(member) {
        return kind_of(this, Character, member).own + at[`player.${member}`];
    }
    get position() {
        return vec(this.#at("position"));
    }
    get velocity() {
        return vec(this.#at("velocity"));
    }
    get motion() {
        check(wasm.slipface_motion_velocity(kind_of(this, Character, "motion").own, scratch.a, scratch.error));
        return vec(scratch.a);
    }
    #flag(bit) {
        return (memory().getUint32(this.#at("flags"), true) & (1 << bit)) !== 0;
    }
    get grounded() { return this.#flag(0); }
    get climbing() { return this.#flag(1); }
    get stuck() { return this.#flag(2); }
    get hazard() { return this.#flag(4); }
    get trapped() { return this.#flag(6); }
    get crushed() { return this.#flag(7); }
    get ground() {
        if (!this.grounded) return null;
        const m = memory();
        return {
            normal: vec(this.#at("ground_normal"), m), face: id_or_null(m.getUint32(this.#at("ground_face"), true)),
            platform: id_or_null(m.getUint32(this.#at("ground_platform"), true)), type: m.getUint8(this.#at("ground_type")),
        };
    }
    get contacts() {
        kind_of(this, Character, "contacts");
        const m = memory();
        return Array.from({ length: m.getUint32(this.report + at["report.contact_count"], true) }, (_, i) => {
            const one = this.contacts_at + i * at.contact, { t, ...contact } = contact_at(one);
            return {
                ...contact, speed: m.getFloat64(one + at["contact.speed"], true),
                pass: passes[m.getUint32(one + at["contact.pass"], true)],
            };
        });
    }
    get events() {
        kind_of(this, Character, "events");
        const m = memory(), count = Math.min(EVENT_ROOM, m.getUint32(this.report + at["report.event_count"], true));
        return Array.from({ length: count }, (_, i) => {
            const one = this.events_at + i * at.event, get = (member) => m.getUint32(one + at[`event.${member}`], true);
            return {
                kind: eventKinds[get("kind")], type: get("type"), platform: id_or_null(get("platform")),
                face: id_or_null(get("face")), value: m.getFloat64(one + at["event.value"], true),
            };
        });
    }
    save() {
        return new Uint8Array(memory().buffer, kind_of(this, Character, "save").own, at.player).slice();
    }
    restore(saved) {
        kind_of(this, Character, "restore");
        if (!(saved instanceof Uint8Array) || saved.length !== at.player)
            throw new SlipfaceError(`restore: found ${saved?.length ?? saved} bytes, expected what save() gave`);
        new Uint8Array(memory().buffer, this.own, at.player).set(saved);
        return this;
    }
    putAt(position, farthest = 2) {
        kind_of(this, Character, "putAt"), kind_of(this.world, World, "world");
        return with_bytes(at.player, (put) => {
            set_vec(scratch.a, position, "position");
            check(wasm.slipface_player_at(this.world.handle, scratch.a, put, scratch.error));
            return with_filters([this.filter], (seen) => {
                check(wasm.slipface_put_player(this.world.handle, this.settings.handle, put, number(farthest), seen, put, scratch.c, scratch.error));
                const done = memory().getUint8(scratch.c) === 1;
                if (done) new Uint8Array(memory().buffer).copyWithin(this.own, put, put + at.player);
                return done;
            });
        });
    }
    changeBody(settings) {
        kind_of(this, Character, "changeBody"), kind_of(settings, Settings, "settings");
        set_vec(scratch.a, settings.radii, "radii");
        return with_filters([this.filter], (seen) => {
            check(wasm.slipface_change_body(this.world.handle, this.settings.handle, this.own, scratch.a, seen, this.own, scratch.c, scratch.error));
            const done = memory().getUint8(scratch.c) === 1;
            if (done) this.settings = settings;
            return done;
        });
    }
}

export function stepCrowd(characters, inputs, dt) {
    need();
    if (!Array.isArray(characters) || !Array.isArray(inputs) || characters.length !== inputs.length)
        throw new SlipfaceError(`stepCrowd: found ${characters?.length} characters and ${inputs?.length} inputs, expected as many`);
    if (characters.length === 0) return;
    const count = characters.length, world = kind_of(kind_of(characters[0], Character, "characters").world, World, "world");
    for (const one of characters)
        if (kind_of(one, Character, "characters").world !== world)
            throw new SlipfaceError("stepCrowd: found characters of different worlds, expected one world");
    if (new Set(characters).size !== count) throw new SlipfaceError("stepCrowd: found a character twice");
    with_filters(characters.map((one) => one.filter), (filters) =>
        with_bytes(count * (8 + at.player + at.input + at.report), (address) => {
            const players = address + 8 * count, inputs_at = players + count * at.player, reports = inputs_at + count * at.input;
            const m = memory(), bytes = new Uint8Array(m.buffer);
            characters.forEach((one, i) => {
                m.setBigUint64(address + 8 * i, kind_of(one.settings, Settings, "settings").handle, true);
                bytes.copyWithin(players + i * at.player, one.own, one.own + at.player);
                bytes.copyWithin(reports + i * at.report, one.report, one.report + at.report);
                set_input(inputs_at + i * at.input, inputs[i]);
            });
            check(wasm.slipface_step_crowd(world.handle, address, players, inputs_at, count, number(dt), filters, reports, scratch.error));
            const after = new Uint8Array(memory().buffer);
            characters.forEach((one, i) => {
                after.copyWithin(one.own, players + i * at.player, players + (i + 1) * at.player);
                after.copyWithin(one.report, reports + i * at.report, reports + (i + 1) * at.report);
            });
        }));
}
