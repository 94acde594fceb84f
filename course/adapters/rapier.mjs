// Rapier's KinematicCharacterController, set up as on https://rapier.rs/docs/user_guides/javascript/character_controller: autostep and
// snap-to-ground on, gravity as part of the desired movement. Its documentation says nothing of ground that moves.
import RAPIER from '@dimforge/rapier3d-compat';
import { package_version, serve } from './line_server.mjs';

await RAPIER.init();

const vector = ([x, y, z]) => ({ x, y, z });
const quaternion = ([x, y, z, w]) => ({ x, y, z, w });

function load({ radius, height, feet, settings, meshes }) {
    const world = new RAPIER.World({ x: 0, y: -settings.gravity, z: 0 });
    const bodies = meshes.map((mesh) => {
        const made = RAPIER.ColliderDesc.trimesh(mesh.positions, mesh.indices, RAPIER.TriMeshFlags.FIX_INTERNAL_EDGES);
        if (!mesh.moves) return void world.createCollider(made);
        const body = world.createRigidBody(RAPIER.RigidBodyDesc.kinematicPositionBased().setTranslation(...mesh.position).setRotation(quaternion(mesh.rotation)));
        world.createCollider(made, body);
        return body;
    });
    const player = world.createRigidBody(RAPIER.RigidBodyDesc.kinematicPositionBased().setTranslation(feet[0], feet[1] + height / 2, feet[2]));
    const collider = world.createCollider(RAPIER.ColliderDesc.capsule(height / 2 - radius, radius), player);
    const controller = world.createCharacterController(0.01);
    const slope = settings.max_slope_deg * Math.PI / 180;
    controller.setMaxSlopeClimbAngle(slope);
    controller.setMinSlopeSlideAngle(slope);
    if (settings.step_height > 0) controller.enableAutostep(settings.step_height, 0.2, true);
    if (settings.snap_distance > 0) controller.enableSnapToGround(settings.snap_distance);
    world.step();

    let grounded = false, fall = 0;
    return {
        step({ dt, wish, jump, poses }) {
            for (const pose of poses) {
                bodies[pose.mesh].setNextKinematicTranslation(vector(pose.position));
                bodies[pose.mesh].setNextKinematicRotation(quaternion(pose.rotation));
            }
            if (grounded) fall = jump ? settings.jump_speed : 0;
            fall -= settings.gravity * dt;
            const wanted = { x: wish[0] * settings.walk_speed * dt, y: fall * dt, z: wish[1] * settings.walk_speed * dt };
            controller.computeColliderMovement(collider, wanted);
            const moved = controller.computedMovement();
            grounded = controller.computedGrounded();
            if (fall > 0 && moved.y < 0.5 * wanted.y) fall = Math.max(0, moved.y / dt); // a ceiling
            const at = player.translation();
            player.setNextKinematicTranslation({ x: at.x + moved.x, y: at.y + moved.y, z: at.z + moved.z });
            world.timestep = dt;
            world.step();
            const now = player.translation();
            return { feet: [now.x, now.y - height / 2, now.z], velocity: [moved.x / dt, moved.y / dt, moved.z / dt], grounded };
        },
        free: () => world.free(),
    };
}

serve({ engine: 'rapier', version: await package_version('@dimforge/rapier3d-compat'), features: ['slope_limit', 'steps', 'snap', 'moving', 'jump'], load });
