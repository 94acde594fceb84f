// A capsule on three-mesh-bvh, moved as in its example characterMovement: five parts of a frame; in each the capsule is pushed out of every
// triangle that it touches, and a push that goes up by enough means ground. No slope limit, no steps, no snap, a level that does not move.
import * as THREE from 'three';
import { MeshBVH } from 'three-mesh-bvh';
import { package_version, serve, still_mesh } from './line_server.mjs';

const parts = 5;

function load({ radius, height, feet, settings, meshes }) {
    const { positions, indices } = still_mesh(meshes);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
    geometry.setIndex(new THREE.BufferAttribute(indices, 1));
    const tree = new MeshBVH(geometry);
    const top = new THREE.Vector3(feet[0], feet[1] + height - radius, feet[2]); // of the capsule's segment
    const velocity = new THREE.Vector3(), pushed = new THREE.Vector3(), on_triangle = new THREE.Vector3(), on_capsule = new THREE.Vector3();
    const segment = new THREE.Line3(), box = new THREE.Box3();
    let grounded = false;

    function part(dt, wish) {
        velocity.y = grounded ? -settings.gravity * dt : velocity.y - settings.gravity * dt;
        top.addScaledVector(velocity, dt);
        top.x += wish[0] * settings.walk_speed * dt;
        top.z += wish[1] * settings.walk_speed * dt;
        segment.start.copy(top);
        segment.end.copy(top);
        segment.end.y -= height - 2 * radius;
        box.makeEmpty().expandByPoint(segment.start).expandByPoint(segment.end).expandByScalar(radius);
        tree.shapecast({
            intersectsBounds: (bounds) => bounds.intersectsBox(box),
            intersectsTriangle: (triangle) => {
                const distance = triangle.closestPointToSegment(segment, on_triangle, on_capsule);
                if (distance >= radius) return;
                const way = on_capsule.sub(on_triangle).normalize();
                segment.start.addScaledVector(way, radius - distance);
                segment.end.addScaledVector(way, radius - distance);
            },
        });
        pushed.subVectors(segment.start, top);
        grounded = pushed.y > Math.abs(dt * velocity.y * 0.25);
        const length = Math.max(0, pushed.length() - 1e-5);
        pushed.normalize();
        top.addScaledVector(pushed, length);
        if (grounded) velocity.set(0, 0, 0);
        else velocity.addScaledVector(pushed, -pushed.dot(velocity));
    }
    return {
        step({ dt, wish, jump }) {
            if (jump && grounded) {
                velocity.y = settings.jump_speed;
                grounded = false;
            }
            const before = top.clone();
            for (let i = 0; i < parts; ++i) part(dt / parts, wish);
            return { feet: [top.x, top.y - height + radius, top.z], velocity: top.clone().sub(before).divideScalar(dt).toArray(), grounded };
        },
    };
}

serve({ engine: 'three-mesh-bvh', version: await package_version('three-mesh-bvh'), features: ['jump'], load });
