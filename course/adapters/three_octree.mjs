// three.js' Octree with a Capsule, moved as in its example games_fps: five parts of a frame, each a translation and one push-out. The
// stick sets the velocity instead of accelerating it. It has no slope limit, no steps, no snap, and its level does not move.
import * as THREE from 'three';
import { Capsule } from 'three/addons/math/Capsule.js';
import { Octree } from 'three/addons/math/Octree.js';
import { package_version, serve, still_mesh } from './line_server.mjs';

const parts = 5;

function load({ radius, height, feet, settings, meshes }) {
    const { positions, indices } = still_mesh(meshes);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
    geometry.setIndex(new THREE.BufferAttribute(indices, 1));
    const octree = new Octree().fromGraphNode(new THREE.Mesh(geometry));
    const player = new Capsule(new THREE.Vector3(feet[0], feet[1] + radius, feet[2]), new THREE.Vector3(feet[0], feet[1] + height - radius, feet[2]), radius);
    const velocity = new THREE.Vector3(), move = new THREE.Vector3();
    let grounded = false;

    function part(dt, wish) {
        let damping = Math.exp(-4 * dt) - 1;
        if (!grounded) {
            velocity.y -= settings.gravity * dt;
            damping *= 0.1;
        }
        velocity.y += velocity.y * damping;
        velocity.x = wish[0] * settings.walk_speed;
        velocity.z = wish[1] * settings.walk_speed;
        player.translate(move.copy(velocity).multiplyScalar(dt));
        const hit = octree.capsuleIntersect(player);
        grounded = false;
        if (!hit) return;
        grounded = hit.normal.y > 0;
        if (!grounded) velocity.addScaledVector(hit.normal, -hit.normal.dot(velocity));
        if (hit.depth >= 1e-10) player.translate(hit.normal.multiplyScalar(hit.depth));
    }
    return {
        step({ dt, wish, jump }) {
            if (jump && grounded) velocity.y = settings.jump_speed;
            for (let i = 0; i < parts; ++i) part(dt / parts, wish);
            return { feet: [player.start.x, player.start.y - radius, player.start.z], velocity: velocity.toArray(), grounded };
        },
    };
}

serve({ engine: 'three.js Octree', version: await package_version('three'), features: ['jump'], load });
