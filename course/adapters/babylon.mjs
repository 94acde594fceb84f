// Babylon's PhysicsCharacterController with Havok, driven as on https://doc.babylonjs.com/features/featuresDeepDive/physics/characterController:
// the states in the air, on the ground and jumping, calculateMovement for the velocity. A scene is rendered each step, because bodies that
// are moved have a velocity only then.
import * as BABYLON from '@babylonjs/core';
import HavokPhysics from '@babylonjs/havok';
import { readFileSync } from 'node:fs';
import { package_version, serve } from './line_server.mjs';

const havok = await HavokPhysics({ wasmBinary: readFileSync(new URL('node_modules/@babylonjs/havok/lib/esm/HavokPhysics.wasm', import.meta.url)) });
BABYLON.Logger.LogLevels = BABYLON.Logger.NoneLogLevel; // its banner would get among the answers
const { Vector3, Quaternion, PhysicsMotionType, CharacterSupportedState } = BABYLON;

function load({ radius, height, feet, settings, meshes }) {
    const engine = new BABYLON.NullEngine();
    const scene = new BABYLON.Scene(engine);
    scene.useRightHandedSystem = true;
    new BABYLON.FreeCamera('camera', Vector3.Zero(), scene);
    const gravity = new Vector3(0, -settings.gravity, 0), up = Vector3.Up(), down = Vector3.Down();
    const plugin = new BABYLON.HavokPlugin(false, havok);
    scene.enablePhysics(gravity, plugin);
    const bodies = meshes.map((one) => {
        const mesh = new BABYLON.Mesh('mesh', scene);
        const data = new BABYLON.VertexData();
        data.positions = one.positions;
        data.indices = one.indices;
        data.applyToMesh(mesh);
        mesh.position.set(...one.position);
        mesh.rotationQuaternion = new Quaternion(...one.rotation);
        const body = new BABYLON.PhysicsBody(mesh, one.moves ? PhysicsMotionType.ANIMATED : PhysicsMotionType.STATIC, false, scene);
        body.shape = new BABYLON.PhysicsShapeMesh(mesh, scene);
        return body;
    });
    const player = new BABYLON.PhysicsCharacterController(new Vector3(feet[0], feet[1] + height / 2, feet[2]), { capsuleHeight: height, capsuleRadius: radius }, scene);
    player.maxSlopeCosine = Math.cos(settings.max_slope_deg * Math.PI / 180);
    player.maxStepHeight = settings.step_height;
    player.acceleration = 1; // "reaching max velocity immediately", as the other adapters' sticks do
    player.maxAcceleration = 1e4;

    let state = 'in the air', input;
    function velocity_of(dt, support) {
        const stick = new Vector3(input.wish[0], 0, input.wish[1]).scale(settings.walk_speed), current = player.getVelocity();
        const forward = stick.lengthSquared() > 0 ? stick.normalizeToNew() : new Vector3(0, 0, 1);
        const supported = support.supportedState === CharacterSupportedState.SUPPORTED;
        state = state === 'jumps' ? 'in the air' : state === 'on the ground' ? (!supported ? 'in the air' : input.jump ? 'jumps' : state) : supported ? 'on the ground' : state;
        if (state === 'jumps') return current.add(up.scale(settings.jump_speed - current.dot(up)));
        if (state === 'in the air') {
            const flat = player.calculateMovement(dt, forward, up, current, Vector3.Zero(), stick, up);
            return flat.add(up.scale(current.dot(up) - flat.dot(up))).add(gravity.scale(dt));
        }
        const surface = support.averageSurfaceVelocity, normal = support.averageSurfaceNormal;
        let moved = player.calculateMovement(dt, forward, normal, current, surface, stick, up).subtract(surface);
        if (moved.dot(up) > 1e-3) { // as fast uphill as on the flat, seen from above
            const length = moved.length() / normal.dot(up);
            moved = normal.cross(moved.normalize()).cross(up).scale(length);
        }
        return moved.add(surface);
    }
    scene.onAfterPhysicsObservable.add(() => {
        const support = player.checkSupport(input.dt, down);
        player.setVelocity(velocity_of(input.dt, support));
        player.integrate(input.dt, support, gravity);
    });
    return {
        step(with_input) {
            input = with_input;
            for (const pose of input.poses) bodies[pose.mesh].setTargetTransform(new Vector3(...pose.position), new Quaternion(...pose.rotation));
            scene.getPhysicsEngine().setTimeStep(input.dt);
            scene.render();
            const at = player.getPosition(), v = player.getVelocity();
            return { feet: [at.x, at.y - height / 2, at.z], velocity: v.asArray(), grounded: state === 'on the ground' };
        },
        free() {
            scene.dispose();
            engine.dispose();
        },
    };
}

serve({ engine: 'babylon with havok', version: `${await package_version('@babylonjs/core')}, ${await package_version('@babylonjs/havok')}`,
    features: ['slope_limit', 'steps', 'moving', 'jump'], load });
