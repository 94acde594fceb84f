// The stepping protocol (docs/course.md) around a controller in JavaScript: reads lines, checks them, answers.
import { createInterface } from 'node:readline';

const out = process.stdout.write.bind(process.stdout);
console.log = console.info = console.warn = console.error; // what libraries print must not get among the answers

class Refused extends Error {
    constructor(place, found, expected) {
        super(`${place}: found ${found}, expected ${expected}`);
        this.error = { place, found: String(found).slice(0, 80), expected };
    }
}
const shown = (value) => JSON.stringify(value) ?? 'nothing';
const number = (value, place, low = -1e6, high = 1e6) => {
    if (typeof value !== 'number' || !(value >= low && value <= high)) throw new Refused(place, shown(value), `a number from ${low} to ${high}`);
    return value;
};
const numbers = (value, place, count) => {
    if (!Array.isArray(value) || value.length !== count) throw new Refused(place, shown(value), `${count} numbers`);
    return value.map((one, i) => number(one, `${place}/${i}`));
};
const list = (value, place) => {
    if (!Array.isArray(value)) throw new Refused(place, shown(value), 'an array');
    return value;
};
const members = (value, place, keys) => {
    if (typeof value !== 'object' || value === null || Array.isArray(value)) throw new Refused(place || '/', shown(value), 'an object');
    for (const key of Object.keys(value)) if (!keys.includes(key)) throw new Refused(place || '/', `the member ${key}`, `only ${keys.join(', ')}`);
    return value;
};
const pose = (value, place) => ({
    position: numbers(value.position, place + '/position', 3),
    rotation: value.rotation === undefined ? [0, 0, 0, 1] : numbers(value.rotation, place + '/rotation', 4),
});

const defaults = { gravity: 20, walk_speed: 6, jump_speed: 8, step_height: 0.4, snap_distance: 0.4, max_slope_deg: 50 };

function read_load(request) {
    members(request, '', ['do', 'run', 'body', 'feet', 'settings', 'meshes']);
    members(request.body, '/body', ['radius', 'height']);
    const settings = { ...defaults, ...members(request.settings ?? {}, '/settings', [...Object.keys(defaults), 'own']) };
    for (const key of Object.keys(defaults)) number(settings[key], '/settings/' + key, 0, 1e4);
    const meshes = list(request.meshes, '/meshes').map((mesh, i) => {
        const at = '/meshes/' + i;
        members(mesh, at, ['positions', 'triangles', 'moves', 'position', 'rotation']);
        const positions = list(mesh.positions, at + '/positions').flatMap((p, k) => numbers(p, `${at}/positions/${k}`, 3));
        const indices = list(mesh.triangles, at + '/triangles').flatMap((t, k) => {
            numbers(t, `${at}/triangles/${k}`, 3).forEach((n, c) => {
                if (!Number.isInteger(n) || n < 0 || n >= positions.length / 3) throw new Refused(`${at}/triangles/${k}/${c}`, n, `an index below ${positions.length / 3}`);
            });
            return t;
        });
        const placed = mesh.moves && mesh.position !== undefined ? pose(mesh, at) : { position: [0, 0, 0], rotation: [0, 0, 0, 1] };
        return { positions: new Float32Array(positions), indices: new Uint32Array(indices), moves: mesh.moves === true, ...placed };
    });
    return {
        radius: number(request.body.radius, '/body/radius', 0.01, 100), height: number(request.body.height, '/body/height', 0.02, 1000),
        feet: numbers(request.feet, '/feet', 3), settings, meshes,
    };
}

function read_step(request, meshes) {
    members(request, '', ['do', 'run', 'dt', 'wish', 'buttons', 'poses']);
    const dt = number(request.dt, '/dt', 1e-4, 60);
    let [x, z] = numbers(request.wish ?? [0, 0], '/wish', 2);
    const length = Math.hypot(x, z);
    if (length > 1) [x, z] = [x / length, z / length];
    const poses = list(request.poses ?? [], '/poses').map((one, i) => {
        if (!meshes[one?.mesh]?.moves) throw new Refused(`/poses/${i}/mesh`, shown(one?.mesh), 'the number of a mesh that moves');
        return { mesh: one.mesh, ...pose(one, '/poses/' + i) };
    });
    return { dt, wish: [x, z], jump: list(request.buttons ?? [], '/buttons').includes('jump'), poses };
}

// `load(level)` makes a run with step({dt, wish, jump, poses}) -> {feet, velocity, grounded} and free(). The stick's press of jump is
// told from its holding here: `jump` is true in the step in which the button goes down.
export async function serve({ engine, version, body = 'capsule', features, note, load }) {
    const runs = new Map();
    let lines = 0;
    const answer = (request) => {
        if (request?.do === 'hello') {
            if (request.protocol !== 1) throw new Refused('/protocol', shown(request.protocol), '1');
            return { ok: 'hello', protocol: 1, engine, version, body, features, note };
        }
        if (!['load', 'step', 'free'].includes(request?.do)) throw new Refused('/do', shown(request?.do), 'hello, load, step or free');
        if (typeof request.run !== 'string') throw new Refused('/run', shown(request.run), 'a string');
        if (request.do === 'load') {
            const level = read_load(request);
            runs.get(request.run)?.made.free?.();
            runs.set(request.run, { level, made: load(level), held: false });
            return { ok: 'load', run: request.run };
        }
        const run = runs.get(request.run);
        if (!run) throw new Refused('/run', request.run, 'the name of a loaded run');
        if (request.do === 'free') {
            run.made.free?.();
            runs.delete(request.run);
            return { ok: 'free', run: request.run };
        }
        const input = read_step(request, run.level.meshes);
        const pressed = input.jump && !run.held;
        run.held = input.jump;
        return { ok: 'step', run: request.run, ...run.made.step({ ...input, jump: pressed }) };
    };
    for await (const line of createInterface({ input: process.stdin })) {
        ++lines;
        let request, made;
        try {
            request = JSON.parse(line);
            made = answer(request);
        } catch (error) {
            const told = error instanceof Refused ? error.error : { place: '/', found: String(error), expected: 'a request' };
            made = { line: lines, run: typeof request?.run === 'string' ? request.run : undefined, error: told };
        }
        out(JSON.stringify(made) + '\n');
    }
}

export const package_version = async (name) => {
    const { readFileSync } = await import('node:fs');
    return JSON.parse(readFileSync(new URL(`node_modules/${name}/package.json`, import.meta.url))).version;
};

// All meshes that do not move, as one.
export function still_mesh(meshes) {
    const positions = [], indices = [];
    for (const mesh of meshes.filter((m) => !m.moves)) {
        const first = positions.length / 3;
        for (const value of mesh.positions) positions.push(value);
        for (const index of mesh.indices) indices.push(first + index);
    }
    return { positions: new Float32Array(positions), indices: new Uint32Array(indices) };
}
