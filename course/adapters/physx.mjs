// PhysX' capsule controller, set up as in its guide's chapter "Character Controllers": stepOffset, slopeLimit as a cosine, a contactOffset of
// a tenth of the radius, the climbing mode constrained, sliding where it is too steep. Bodies are ridden by the behaviour flag for it.
// It has no snap to the ground; games add a constant downward motion, and so does this.
import { readFileSync } from 'node:fs';
import { package_version, serve, still_mesh } from './line_server.mjs';

// The build for the web refuses node by its version; it needs nothing else of a browser but where it lies.
const versions = process.versions;
Object.defineProperty(process, 'versions', { value: {}, configurable: true });
globalThis.window ??= globalThis;
const { default: start } = await import('physx-js-webidl');
const P = await start({ wasmBinary: readFileSync(new URL('node_modules/physx-js-webidl/physx-js-webidl.wasm', import.meta.url)) });
Object.defineProperty(process, 'versions', { value: versions });
const top = P.PxTopLevelFunctions.prototype;

const foundation = top.CreateFoundation(top.PHYSICS_VERSION, new P.PxDefaultAllocator(), new P.PxDefaultErrorCallback());
const tolerances = new P.PxTolerancesScale();
const physics = top.CreatePhysics(top.PHYSICS_VERSION, foundation, tolerances);
const cooking = new P.PxCookingParams(tolerances);
const material = physics.createMaterial(0.5, 0.5, 0);
const dispatcher = top.DefaultCpuDispatcherCreate(0);

function mesh_geometry({ positions, indices }) {
    const points = new P.PxArray_PxVec3(positions.length / 3), corners = new P.PxArray_PxU32(indices.length);
    const vector = new P.PxVec3();
    for (let i = 0; i < positions.length / 3; ++i) {
        [vector.x, vector.y, vector.z] = positions.subarray(3 * i, 3 * i + 3);
        points.set(i, vector);
    }
    indices.forEach((index, i) => corners.set(i, index));
    const desc = new P.PxTriangleMeshDesc();
    desc.points.count = positions.length / 3;
    desc.points.stride = 12;
    desc.points.data = points.begin();
    desc.triangles.count = indices.length / 3;
    desc.triangles.stride = 12;
    desc.triangles.data = corners.begin();
    const mesh = top.CreateTriangleMesh(cooking, desc);
    for (const one of [points, corners, vector, desc]) P.destroy(one);
    return [new P.PxTriangleMeshGeometry(mesh, new P.PxMeshScale(new P.PxVec3(1, 1, 1), new P.PxQuat(0, 0, 0, 1))), mesh];
}

function load({ radius, height, feet, settings, meshes }) {
    const scene_desc = new P.PxSceneDesc(tolerances);
    scene_desc.gravity = new P.PxVec3(0, -settings.gravity, 0);
    scene_desc.cpuDispatcher = dispatcher;
    scene_desc.filterShader = top.DefaultFilterShader();
    const scene = physics.createScene(scene_desc), made = [];
    const flags = new P.PxShapeFlags(P.PxShapeFlagEnum.eSCENE_QUERY_SHAPE | P.PxShapeFlagEnum.eSIMULATION_SHAPE);
    const pose_of = ({ position, rotation }) => {
        const pose = new P.PxTransform(P.PxIDENTITYEnum.PxIdentity);
        pose.p = new P.PxVec3(...position);
        pose.q = new P.PxQuat(...rotation);
        return pose;
    };
    const add = (mesh, placed, moves) => {
        const [geometry, cooked] = mesh_geometry(mesh), pose = pose_of(placed);
        const actor = moves ? physics.createRigidDynamic(pose) : physics.createRigidStatic(pose);
        if (moves) actor.setRigidBodyFlag(P.PxRigidBodyFlagEnum.eKINEMATIC, true);
        const shape = physics.createShape(geometry, material, true, flags);
        shape.setSimulationFilterData(new P.PxFilterData(1, 1, 0, 0));
        actor.attachShape(shape);
        scene.addActor(actor);
        made.push(actor, cooked);
        return actor;
    };
    const still = still_mesh(meshes);
    if (still.indices.length) add(still, { position: [0, 0, 0], rotation: [0, 0, 0, 1] }, false);
    const movers = meshes.map((mesh) => mesh.moves ? add(mesh, mesh, true) : null);

    const manager = top.CreateControllerManager(scene);
    const desc = new P.PxCapsuleControllerDesc();
    desc.radius = radius;
    desc.height = height - 2 * radius;
    desc.contactOffset = 0.1 * radius;
    desc.stepOffset = settings.step_height;
    desc.slopeLimit = Math.cos(settings.max_slope_deg * Math.PI / 180);
    desc.climbingMode = P.PxCapsuleClimbingModeEnum.eCONSTRAINED;
    desc.nonWalkableMode = P.PxControllerNonWalkableModeEnum.ePREVENT_CLIMBING_AND_FORCE_SLIDING;
    desc.material = material;
    const behavior = new P.PxControllerBehaviorCallbackImpl();
    behavior.getShapeBehaviorFlags = () => P.PxControllerBehaviorFlagEnum.eCCT_CAN_RIDE_ON_OBJECT;
    behavior.getControllerBehaviorFlags = behavior.getObstacleBehaviorFlags = () => 0;
    desc.behaviorCallback = behavior;
    desc.position = new P.PxExtendedVec3(feet[0], feet[1] + height / 2, feet[2]);
    const player = manager.createController(desc), filters = new P.PxControllerFilters(), move = new P.PxVec3();
    let grounded = false, fall = 0;

    return {
        step({ dt, wish, jump, poses }) {
            for (const pose of poses) {
                const target = pose_of(pose);
                movers[pose.mesh].setKinematicTarget(target);
                P.destroy(target);
            }
            scene.simulate(dt);
            scene.fetchResults(true);
            if (grounded) fall = jump ? settings.jump_speed : 0;
            fall -= settings.gravity * dt;
            [move.x, move.y, move.z] = [wish[0] * settings.walk_speed * dt, fall * dt, wish[1] * settings.walk_speed * dt];
            const before = player.getFootPosition(), y = before.y;
            const hit = player.move(move, 0.0001, dt, filters);
            grounded = hit.isSet(P.PxControllerCollisionFlagEnum.eCOLLISION_DOWN);
            if (fall > 0 && hit.isSet(P.PxControllerCollisionFlagEnum.eCOLLISION_UP)) fall = 0;
            const now = player.getFootPosition();
            return { feet: [now.x, now.y, now.z], velocity: [move.x / dt, (now.y - y) / dt, move.z / dt], grounded };
        },
        free() {
            player.release();
            manager.release();
            for (const one of made) one.release();
            scene.release();
        },
    };
}

serve({ engine: 'physx', version: await package_version('physx-js-webidl'), features: ['slope_limit', 'steps', 'moving', 'jump'], load });
