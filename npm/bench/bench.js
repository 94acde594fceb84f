// One character on bumpy ground with boxes, at 60 Hz, in slipface and in other packages for the web: microseconds of the process per step, in
// turns, the least of the rounds. npm install && npm start
import { readFile, readdir } from "node:fs/promises";
import { gzipSync } from "node:zlib";

import initJolt from "jolt-physics";
import RAPIER from "@dimforge/rapier3d-compat";
import { Character, Settings, World, load } from "../index.js";

const dt = 1 / 60, gravity = 20, speed = 6, radius = 0.4, half_height = 0.5; // of the capsules; slipface's ellipsoid is as wide and as high
const side = 120;

// The same numbers in every run.
let state = 1;
const random = () => (state = (Math.imul(state, 1103515245) + 12345) >>> 0) / 2 ** 32;

function ground() {
    const positions = [], indices = [];
    for (let z = 0; z < side; ++z)
        for (let x = 0; x < side; ++x) positions.push(x - side / 2, 0.5 * random(), z - side / 2);
    for (let z = 0; z + 1 < side; ++z)
        for (let x = 0; x + 1 < side; ++x) {
            const i = z * side + x;
            indices.push(i, i + side, i + 1, i + 1, i + side, i + side + 1);
        }
    for (let n = 0; n < 150; ++n) {
        const first = positions.length / 3, x = (random() - 0.5) * 80, z = (random() - 0.5) * 80, size = 0.5 + random(), high = 0.3 + 2 * random();
        for (const [i, k, j] of [[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1], [0, 1, 0], [1, 1, 0], [1, 1, 1], [0, 1, 1]])
            positions.push(x + i * size, -1 + k * (high + 1), z + j * size);
        for (const corner of [0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7, 4, 5, 6, 4, 6, 7]) indices.push(first + corner);
    }
    return { positions: Float32Array.from(positions), indices: Uint32Array.from(indices) };
}
const mesh = ground();
const wish = (tick) => [Math.cos(0.01 * tick), Math.sin(0.013 * tick)];

async function slipface() {
    await load();
    const player = new Character(new World(mesh), new Settings(), { x: 0, y: 2, z: 0 });
    return (tick) => {
        const [x, z] = wish(tick);
        player.step({ x, z }, dt);
        return player.position.y;
    };
}

async function rapier() {
    await RAPIER.init();
    const world = new RAPIER.World({ x: 0, y: -gravity, z: 0 });
    world.createCollider(RAPIER.ColliderDesc.trimesh(mesh.positions, mesh.indices, RAPIER.TriMeshFlags.FIX_INTERNAL_EDGES));
    const body = world.createRigidBody(RAPIER.RigidBodyDesc.kinematicPositionBased().setTranslation(0, 2, 0));
    const collider = world.createCollider(RAPIER.ColliderDesc.capsule(half_height, radius), body);
    const controller = world.createCharacterController(0.01);
    controller.setMaxSlopeClimbAngle(0.87);
    controller.enableAutostep(0.4, 0.2, true);
    controller.enableSnapToGround(0.4);
    world.timestep = dt;
    world.step();
    let fall = 0;
    return (tick) => {
        const [x, z] = wish(tick);
        fall -= gravity * dt;
        controller.computeColliderMovement(collider, { x: x * speed * dt, y: fall * dt, z: z * speed * dt });
        const moved = controller.computedMovement(), at = body.translation();
        if (controller.computedGrounded()) fall = 0;
        body.setNextKinematicTranslation({ x: at.x + moved.x, y: at.y + moved.y, z: at.z + moved.z });
        world.step();
        return at.y;
    };
}

async function jolt() {
    const Jolt = await initJolt();
    const settings = new Jolt.JoltSettings();
    const pairs = new Jolt.ObjectLayerPairFilterTable(1), layers = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
    pairs.EnableCollision(0, 0);
    layers.MapObjectToBroadPhaseLayer(0, new Jolt.BroadPhaseLayer(0));
    settings.mObjectLayerPairFilter = pairs;
    settings.mBroadPhaseLayerInterface = layers;
    settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 1, pairs, 1);
    settings.mMaxWorkerThreads = 1;
    const world = new Jolt.JoltInterface(settings), system = world.GetPhysicsSystem(), bodies = system.GetBodyInterface();
    const triangles = new Jolt.TriangleList();
    triangles.resize(mesh.indices.length / 3);
    for (let i = 0; i < mesh.indices.length; ++i) {
        const corner = triangles.at(Math.trunc(i / 3)).get_mV(i % 3), from = 3 * mesh.indices[i];
        [corner.x, corner.y, corner.z] = mesh.positions.subarray(from, from + 3);
    }
    const shape = new Jolt.MeshShapeSettings(triangles, new Jolt.PhysicsMaterialList()).Create().Get();
    const body = bodies.CreateBody(new Jolt.BodyCreationSettings(shape, new Jolt.RVec3(0, 0, 0), new Jolt.Quat(0, 0, 0, 1), Jolt.EMotionType_Static, 0));
    bodies.AddBody(body.GetID(), Jolt.EActivation_DontActivate);
    const made = new Jolt.CharacterVirtualSettings();
    made.mMaxSlopeAngle = 0.87;
    made.mShape = new Jolt.CapsuleShapeSettings(half_height, radius).Create().Get();
    made.mEnhancedInternalEdgeRemoval = true;
    const player = new Jolt.CharacterVirtual(made, new Jolt.RVec3(0, 2, 0), new Jolt.Quat(0, 0, 0, 1), system);
    const update = new Jolt.ExtendedUpdateSettings();
    update.mWalkStairsStepUp = new Jolt.Vec3(0, 0.4, 0);
    update.mStickToFloorStepDown = new Jolt.Vec3(0, -0.4, 0);
    const filters = [new Jolt.DefaultBroadPhaseLayerFilter(world.GetObjectVsBroadPhaseLayerFilter(), 0),
        new Jolt.DefaultObjectLayerFilter(world.GetObjectLayerPairFilter(), 0), new Jolt.BodyFilter(), new Jolt.ShapeFilter()];
    const pull = new Jolt.Vec3(0, -gravity, 0), velocity = new Jolt.Vec3(0, 0, 0), temporary = world.GetTempAllocator();
    return (tick) => {
        const [x, z] = wish(tick), grounded = player.GetGroundState() === Jolt.EGroundState_OnGround;
        velocity.Set(x * speed, (grounded ? 0 : player.GetLinearVelocity().GetY()) - gravity * dt, z * speed);
        player.SetLinearVelocity(velocity);
        player.ExtendedUpdate(dt, pull, update, ...filters, temporary);
        return player.GetPosition().GetY();
    };
}

async function gzip_of(...files) {
    let bytes = 0;
    for (const file of files) bytes += gzipSync(await readFile(new URL(file, import.meta.url)), { level: 9 }).length;
    return `${Math.round(bytes / 1000)} kB`;
}
const version = async (name) => JSON.parse(await readFile(new URL(`node_modules/${name}/package.json`, import.meta.url))).version;
const dist = "node_modules/@dimforge/rapier3d-compat/dist/";
const rapier_file = (await readdir(new URL(dist, import.meta.url))).includes("rapier.mjs") ? "rapier.mjs" : "rapier.es.js";
const candidates = [
    { name: "slipface", size: await gzip_of("../index.js", "../mover.wasm"), run: await slipface() },
    { name: `jolt-physics ${await version("jolt-physics")}, CharacterVirtual`, size: await gzip_of("node_modules/jolt-physics/dist/jolt-physics.wasm-compat.js"), run: await jolt() },
    { name: `@dimforge/rapier3d-compat ${await version("@dimforge/rapier3d-compat")}, KinematicCharacterController`, size: await gzip_of(dist + rapier_file), run: await rapier() },
];
const rounds = 9, steps = 3000;
let lowest = Infinity;
for (const one of candidates) {
    one.times = [];
    one.tick = 0;
}
for (let round = -1; round < rounds; ++round)
    for (const one of candidates) {
        const begin = process.cpuUsage();
        for (let i = 0; i < steps; ++i) lowest = Math.min(lowest, one.run(one.tick++));
        if (round >= 0) one.times.push((process.cpuUsage(begin).user + process.cpuUsage(begin).system) / steps);
    }
if (!(lowest > -1)) throw new Error(`somebody fell through the ground, to ${lowest} m`);
console.log(`| package | us per step | gzip |\n|---|---|---|`);
for (const { name, times, size } of candidates) console.log(`| ${name} | ${Math.min(...times).toFixed(1)} | ${size} |`);
