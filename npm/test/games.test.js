// What a game does with the package, and what goes wrong with it.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import test from "node:test";

import { Character, Settings, SlipfaceError, World, load, merge, stepCrowd } from "../index.js";

const dt = 1 / 60;
const floor = {
    positions: new Float32Array([-20, 0, -20, -20, 0, 20, 20, 0, 20, 20, 0, -20]),
    indices: new Uint32Array([0, 1, 2, 0, 2, 3]),
};
const wall = { positions: new Float32Array([4, 0, 9, 4, 0, -9, 4, 3, -9, 4, 3, 9]), indices: floor.indices };

// The module that load() makes, for its memory.
let instance = null;
const instantiate = WebAssembly.instantiate;
WebAssembly.instantiate = async (...given) => (instance = await instantiate(...given));

test("what is used before load() says so", () => {
    assert.throws(() => new World(floor), /await load\(\) first/);
    assert.throws(() => new Settings(), SlipfaceError);
});

test("load takes the bytes of the module, too, and only once", async () => {
    await assert.rejects(load(42), /expected an address/);
    const bytes = await readFile(new URL("../mover.wasm", import.meta.url));
    const first = load(bytes);
    assert.equal(load(), first);
    await first;
});

test("a character falls, lands, walks to the wall and touches it", () => {
    const world = new World(merge([floor, wall]));
    const character = new Character(world, new Settings({ walk_speed: 5 }), { x: -2, y: 3, z: 0 });
    const kinds = [];
    let fastest = 0;
    for (let tick = 0; tick < 200; ++tick) {
        character.step({ x: 1 }, dt);
        kinds.push(...character.events.map((event) => event.kind));
        for (const contact of character.contacts)
            if (contact.normal.x < -0.9) fastest = Math.max(fastest, contact.speed);
    }
    assert.deepEqual(kinds, ["landed"]);
    assert.ok(Math.abs(fastest - 5) < 0.01, `met the wall at ${fastest} m/s`);
    assert.ok(character.grounded);
    assert.ok(Math.abs(character.position.x - 3.598) < 1e-3);
    assert.ok(character.ground.face < 2);
    assert.ok(Math.hypot(character.motion.x, character.motion.y, character.motion.z) < 1e-6);
});

test("three.js geometry, with and without an index, placed by a matrix that mirrors", () => {
    const attribute = (array) => ({ count: array.length / 3, getX: (i) => array[3 * i], getY: (i) => array[3 * i + 1], getZ: (i) => array[3 * i + 2] });
    const indexed = { attributes: { position: attribute(floor.positions) }, index: { array: Uint16Array.from(floor.indices) }, groups: [{ start: 0, count: 6 }] };
    const corners = [...floor.indices].flatMap((i) => [...floor.positions.slice(3 * i, 3 * i + 3)]);
    const plain = { attributes: { position: attribute(corners) }, index: null };
    const up = [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 2, 0, 1];
    for (const geometry of [indexed, plain, { positions: [...floor.positions], indices: [...floor.indices] }]) {
        const world = World.fromGeometry(geometry, { matrix: { elements: up } });
        const hit = world.ray({ x: 1, y: 9, z: 1 }, { x: 0, y: -1, z: 0 });
        assert.ok(Math.abs(hit.t - 7) < 1e-9);
        assert.equal(hit.back, false);
        assert.equal(new World(geometry).bounds.triangles, 2);
        assert.equal(new World(merge([geometry])).addPlatform(geometry), 0);
        world.dispose();
    }
});

test("queries find what is there", () => {
    const world = new World(merge([floor, { ...wall, type: 1, groups: 2 }]));
    const radii = { x: 0.4, y: 0.9, z: 0.4 };
    const contact = world.sweep(radii, { x: 0, y: 1, z: 0 }, { x: 10, y: 0, z: 0 });
    assert.ok(Math.abs(contact.t - 0.36) < 1e-9);
    assert.equal(contact.type, 1);
    assert.equal(contact.platform, null);
    assert.equal(world.sweep(radii, { x: 0, y: 1, z: 0 }, { x: 10, y: 0, z: 0 }, { mask: ~2 }), null);
    assert.equal(world.sweep(radii, { x: 0, y: 1, z: 0 }, { x: 10, y: 0, z: 0 }, { ignoredTypes: [1] }), null);
    assert.equal(world.sweep(radii, { x: 0, y: 1, z: 0 }, { x: 10, y: 0, z: 0 }, { sees: (platform, triangle) => triangle < 2 }), null);
    assert.ok(Math.abs(world.closestPoint({ x: 1, y: 2, z: 1 }).distance - 2) < 1e-9);
    assert.equal(world.closestPoint({ x: 1, y: 2, z: 1 }, 1), null);
    assert.equal(world.overlaps(radii, { x: 3.8, y: 0.5, z: 0 }).length, 2);
    assert.deepEqual(world.bounds.highest, { x: 20, y: 3, z: 20 });
});

test("platforms carry, triggers report, and a type is changed by its parameters", () => {
    const world = new World(floor);
    const goal = world.addType("goal", { solid: false });
    const box = world.addPlatform({ ...wall, types: new Uint8Array([goal, goal]) });
    const lift = world.addPlatform({ positions: floor.positions.map((x) => x / 10), indices: floor.indices });
    const rider = new Character(world, new Settings(), { x: 0, y: 1.91, z: 0 });
    const seen = [];
    for (let tick = 0; tick < 120; ++tick) {
        world.movePlatform(lift, { x: 0, y: 1 + 0.01 * tick, z: 0 }, null, dt);
        world.movePlatform(box, { x: -0.08 * tick, y: 0, z: 0 }, undefined, dt);
        rider.step(undefined, dt);
        seen.push(...rider.events.filter((event) => event.type === goal).map((event) => event.kind));
    }
    assert.equal(rider.ground.platform, lift);
    assert.ok(Math.abs(rider.position.y - 3.092) < 0.01);
    assert.equal(seen[0], "entered");
    assert.equal(seen.at(-1), "departed");
    assert.equal(seen.filter((kind) => kind === "stayed").length, seen.length - 2);
    world.setType(world.type("ice"), { friction: 0.5, velocity: { x: 1, y: 0, z: 0 } });
    assert.equal(world.type("nothing of this name"), null);
});

test("a crowd pushes, filters of characters let it pass, and a rollback gives the same bytes", () => {
    const world = new World(floor), settings = new Settings();
    const two = [-1, 1].map((x) => new Character(world, settings, { x, y: 0.902, z: 0 }));
    const inputs = [{ x: 1 }, { x: -1 }];
    const past = two.map((one) => one.save());
    const run = () => {
        for (let tick = 0; tick < 30; ++tick) stepCrowd(two, inputs, dt);
    };
    run();
    assert.ok(two[0].position.x < 0);
    const after = two.map((one) => one.save());
    two.forEach((one, i) => one.restore(past[i]));
    run();
    assert.deepEqual(two.map((one) => one.save()), after);
    two.forEach((one, i) => one.restore(past[i]));
    two[0].filter = { mask: 1, groups: 1 };
    two[1].filter = { groups: 2 };
    run();
    assert.ok(two[0].position.x < 0 === false && two[1].position.x < 0);
});

test("bodies change where there is room, and a teleport finds some", () => {
    const world = new World(merge([floor, { positions: floor.positions.map((x, i) => (i % 3 === 1 ? 1.5 : x)), indices: floor.indices }]));
    const tall = new Settings(), small = new Settings({ radius_y: 0.45 });
    const character = new Character(world, small, { x: 0, y: 0.46, z: 0 });
    character.step({}, dt);
    assert.equal(character.changeBody(tall), false);
    assert.equal(character.settings, small);
    assert.equal(character.putAt({ x: 3, y: 0.1, z: 3 }), true);
    assert.equal(character.putAt({ x: 3, y: 0.75, z: 3 }, 0), true);
});

test("settings have names, ranges and words", () => {
    const settings = new Settings("momentum");
    for (const one of Settings.list()) {
        assert.ok(one.minimum <= one.initial && one.initial <= one.maximum, one.name);
        settings.set(one.name, one.maximum);
        assert.equal(settings.get(one.name), one.maximum);
    }
    settings.set("max_slope", "50deg").set("step_up", false).set("push_out", "iterative");
    assert.ok(Math.abs(settings.get("max_slope") - 0.8727) < 1e-4);
});

test("memory grows under a large world, and what was there stays", () => {
    const character = new Character(new World(floor), new Settings(), { x: 0, y: 1, z: 0 });
    const side = 300, corners = [], indices = [];
    for (let i = 0; i < side * side; ++i) corners.push(i % side, Math.sin(i), Math.trunc(i / side));
    for (let z = 0; z + 1 < side; ++z)
        for (let x = 0; x + 1 < side; ++x) {
            const i = z * side + x;
            indices.push(i, i + side, i + 1, i + 1, i + side, i + side + 1);
        }
    const large = new World({ positions: Float32Array.from(corners), indices: Uint32Array.from(indices) });
    character.step({ x: 1 }, dt);
    assert.ok(character.position.x > 0);
    assert.equal(large.bounds.triangles, indices.length / 3);
    large.dispose();
});

test("nothing leaks, with and without dispose()", { timeout: 120000 }, async () => {
    const side = 40, corners = [], indices = [];
    for (let i = 0; i < side * side; ++i) corners.push(i % side, 0, Math.trunc(i / side));
    for (let z = 0; z + 1 < side; ++z)
        for (let x = 0; x + 1 < side; ++x) {
            const i = z * side + x;
            indices.push(i, i + side, i + 1, i + 1, i + side, i + side + 1);
        }
    const mesh = { positions: Float32Array.from(corners), indices: Uint32Array.from(indices) };
    const make = async (count) => {
        for (let i = 0; i < count; ++i) {
            const world = new World(mesh);
            const character = new Character(world, new Settings(), { x: 9, y: 2, z: 9 });
            if (i % 2 === 0) character.dispose(), world.dispose();
            if (i % 20 !== 0) continue;
            global.gc();
            await new Promise((done) => setTimeout(done, 0));
        }
    };
    await make(100);
    const before = instance.exports.memory.buffer.byteLength;
    await make(400);
    assert.ok(instance.exports.memory.buffer.byteLength <= before + 4e6, `${before} bytes became ${instance.exports.memory.buffer.byteLength}`);
});

test("misuses are errors, and none of them ends the module", () => {
    const world = new World(merge([floor, wall])), settings = new Settings();
    const character = new Character(world, settings, { x: 0, y: 1, z: 0 });
    const radii = { x: 0.4, y: 0.9, z: 0.4 }, zero = { x: 0, y: 0, z: 0 }, up = { x: 0, y: 1, z: 0 };
    const wrong = { positions: floor.positions, indices: new Uint32Array([0, 1, 9]) };
    const gone = new World(floor), gone_settings = new Settings(), gone_character = new Character(world, settings, up);
    for (const one of [gone, gone_settings, gone_character]) one.dispose(), one.dispose();
    const misuses = [
        () => new World(), () => new World(null), () => new World({}), () => new World({ positions: "abc" }),
        () => new World({ positions: new Float64Array(8) }), () => new World({ positions: new Float32Array(8) }),
        () => new World(wrong), () => new World({ ...floor, indices: new Float32Array(6) }),
        () => new World({ ...floor, indices: new Uint32Array(4) }), () => new World({ ...floor, types: new Uint8Array(1) }),
        () => new World({ ...floor, types: new Uint8Array([0, 99]) }), () => new World({ ...floor, groups: new Uint32Array(7) }),
        () => new World({ positions: new Float32Array([0, 0, NaN, 1, 0, 0, 0, 0, 1]) }),
        () => World.fromGeometry({}), () => World.fromGeometry(null), () => merge([{ ...floor, type: 400 }]), () => merge([{ ...floor, type: -1 }]),
        () => new Settings("no such preset"), () => new Settings({ gravty: 1 }), () => settings.set("gravity", -1),
        () => settings.set("gravity", NaN), () => settings.set("gravity", "much"), () => settings.set("gravity", {}),
        () => settings.set("gravity"), () => settings.get("gravty"), () => settings.get(), () => gone_settings.get("gravity"),
        () => new Character(), () => new Character(world, settings), () => new Character(world, settings, { x: 0, y: NaN, z: 0 }),
        () => new Character(settings, world, up), () => new Character(gone, settings, up), () => new Character(world, gone_settings, up),
        () => character.step({ x: NaN }, dt), () => character.step({ x: "1" }, dt), () => character.step({}, 0),
        () => character.step({}), () => character.step({}, -1), () => character.step({}, Infinity), () => gone_character.step({}, dt),
        () => gone_character.position, () => gone_character.contacts, () => gone_character.save(),
        () => character.restore(), () => character.restore(new Uint8Array(3)), () => character.restore([1, 2]),
        () => character.restore(new Uint8Array(character.save().length)).step({}, dt),
        () => character.putAt(zero, -1), () => character.putAt({ x: 1 }), () => character.changeBody(world),
        () => stepCrowd([character], [], dt), () => stepCrowd(character, {}, dt), () => stepCrowd([character, character], [{}, {}], dt),
        () => stepCrowd([gone_character], [{}], dt),
        () => world.sweep({ ...radii, y: 0 }, zero, up), () => world.sweep({ ...radii, x: -1 }, zero, up),
        () => world.sweep(radii, { x: NaN, y: 0, z: 0 }, up), () => world.sweep(radii, zero), () => world.sweep(),
        () => world.ray(zero, zero), () => world.ray(zero, { x: Infinity, y: 0, z: 0 }), () => world.ray(zero, up, -1),
        () => world.ray(zero, up, NaN), () => world.ray(zero, up, 1, { mask: 1.5 }), () => world.ray(zero, up, 1, { ignoredTypes: [300] }),
        () => world.ray(up, { x: 0, y: -1, z: 0 }, 9, { sees: 3 }),
        () => world.ray(up, { x: 0, y: -1, z: 0 }, 9, { sees: () => { throw new SlipfaceError("an error of the game's own"); } }),
        () => world.ray(up, { x: 0, y: -1, z: 0 }, 9, { sees: () => world.ray(up, zero) }),
        () => world.closestPoint(zero, -1), () => world.closestPoint({}), () => world.overlaps({ ...radii, z: 0 }, zero),
        () => world.overlaps(radii, { x: 0, y: 0 }), () => world.addType("ice"), () => world.addType(""),
        () => world.addType("new", { slippery: 1 }), () => world.setType(99, {}) ?? world.setType(99, { friction: 1 }),
        () => world.setType(0, { friction: [1, 2] }), () => world.setType(0, { friction: 99 }), () => world.setFaceType(99, 0),
        () => world.setFaceType(0, 99), () => world.setFaceType(-1, 0), () => world.setFaceType(0.5, 0), () => world.setFaceGroups(99, 1),
        () => world.setFaceGroups(0, 1, 7), () => world.addPlatform({}), () => world.addPlatform(wrong),
        () => world.movePlatform(0, zero, null, dt), () => world.movePlatform(null, zero, null, dt), () => gone.ray(zero, up), () => gone.bounds,
    ];
    misuses.forEach((misuse, i) => {
        let found = null;
        try {
            misuse();
        } catch (error) {
            found = error;
        }
        assert.ok(found instanceof SlipfaceError && found.message.length > 5, `misuse ${i}, ${misuse}: ${found}`);
    });
    assert.ok(misuses.length >= 60);
    // And all goes on.
    const walker = new Character(world, settings, { x: 0, y: 1, z: 0 });
    for (let tick = 0; tick < 30; ++tick) walker.step({ x: -1 }, dt);
    assert.ok(walker.grounded && walker.position.x < -1);
});
