// The same walk as tests/mover/tst_npm_bits.cpp: the bits of WebAssembly are those of native code.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import test from "node:test";

import { Button, Character, Settings, World, load, stepCrowd } from "../index.js";

class Random {
    constructor(seed) {
        this.state = BigInt(seed);
    }
    between(low, high) {
        this.state = BigInt.asUintN(64, this.state * 6364136223846793005n + 1442695040888963407n);
        return low + (high - low) * (Number(this.state >> 11n) * 2 ** -53);
    }
    below(count) {
        return Math.trunc(this.between(0, count));
    }
}

function quads(corners) {
    return {
        positions: Float32Array.from(corners.flat()),
        indices: Uint32Array.from(corners.flatMap((_, i) => [0, 1, 2, 0, 2, 3].map((k) => 4 * i + k))),
    };
}

function walk(preset) {
    const random = new Random(11);
    const corners = [], types = [];
    for (let i = 0; i < 49; ++i) {
        const x = 3 * (i % 7) - 10, z = 3 * Math.trunc(i / 7) - 10;
        const y = [0, 0, 0, 0].map(() => random.between(-0.6, 0.6));
        corners.push([x, y[0], z, x, y[1], z + 3, x + 3, y[2], z + 3, x + 3, y[3], z]);
        const type = random.below(8);
        types.push(type, type);
    }
    corners.push([-40, -1, -40, -40, -1, 40, 40, -1, 40, 40, -1, -40]);
    types.push(0, 0);
    const world = new World({ ...quads(corners), types: Uint8Array.from(types) });
    const lift = world.addPlatform(quads([[-2, 0, -2, -2, 0, 2, 2, 0, 2, 2, 0, -2]]));
    const settings = new Settings(preset);
    const players = Array.from({ length: 8 }, () => {
        const x = random.between(-6, 6), z = random.between(-6, 6);
        return new Character(world, settings, { x, y: 2, z });
    });
    let inputs = [];
    let hash = 0xcbf29ce484222325n;
    for (let tick = 0; tick < 240; ++tick) {
        if (tick % 10 === 0)
            inputs = players.map(() => {
                const x = random.between(-1, 1), z = random.between(-1, 1);
                return { x, z, buttons: random.below(3) === 0 ? Button.jump : 0 };
            });
        world.movePlatform(lift, { x: 0.03 * tick - 3, y: 0.01 * tick, z: 0 }, { x: 0, y: 0.01 * tick, z: 0, w: 1 }, 1 / 60);
        stepCrowd(players, inputs, 1 / 60);
        for (const player of players)
            for (const byte of player.save()) hash = BigInt.asUintN(64, (hash ^ BigInt(byte)) * 0x100000001b3n);
    }
    for (const one of [...players, settings, world]) one.dispose();
    return hash.toString(16).padStart(16, "0");
}

// Triggers are looked for here and not there, and there are none.
for (const [preset, expected] of Object.entries(JSON.parse(await readFile(new URL("hashes.json", import.meta.url)))))
    test(`${preset} walks with the bits of native code`, async () => {
        await load();
        assert.equal(walk(preset), expected);
    });
