// Jolt's CharacterVirtual with ExtendedUpdate, driven as in Samples/Tests/Character/CharacterVirtualTest of JoltPhysics: velocity from the
// ground's, the old vertical one, gravity and the stick; the listener keeps an idle player from sliding on ground that is not too steep.
import initJolt from 'jolt-physics';
import { package_version, serve, still_mesh } from './line_server.mjs';

const Jolt = await initJolt();
const still_layer = 0, moving_layer = 1;

function make_system() {
    const settings = new Jolt.JoltSettings();
    const pairs = new Jolt.ObjectLayerPairFilterTable(2);
    pairs.EnableCollision(still_layer, moving_layer);
    pairs.EnableCollision(moving_layer, moving_layer);
    const layers = new Jolt.BroadPhaseLayerInterfaceTable(2, 2);
    layers.MapObjectToBroadPhaseLayer(still_layer, new Jolt.BroadPhaseLayer(0));
    layers.MapObjectToBroadPhaseLayer(moving_layer, new Jolt.BroadPhaseLayer(1));
    settings.mObjectLayerPairFilter = pairs;
    settings.mBroadPhaseLayerInterface = layers;
    settings.mMaxBodies = 64;
    settings.mMaxBodyPairs = settings.mMaxContactConstraints = 256;
    settings.mMaxWorkerThreads = 1;
    settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 2);
    const jolt = new Jolt.JoltInterface(settings);
    Jolt.destroy(settings);
    return jolt;
}

function mesh_shape({ positions, indices }) {
    const triangles = new Jolt.TriangleList();
    triangles.resize(indices.length / 3);
    for (let i = 0; i < indices.length / 3; ++i)
        for (let k = 0; k < 3; ++k) {
            const corner = triangles.at(i).get_mV(k), from = 3 * indices[3 * i + k];
            [corner.x, corner.y, corner.z] = positions.subarray(from, from + 3);
        }
    const settings = new Jolt.MeshShapeSettings(triangles, new Jolt.PhysicsMaterialList());
    const result = settings.Create();
    if (result.HasError()) throw new Error('MeshShape: ' + result.GetError().c_str());
    const shape = result.Get();
    shape.AddRef(); // until a body has it
    result.Clear();
    Jolt.destroy(triangles);
    Jolt.destroy(settings);
    return shape;
}

function load({ radius, height, feet, settings, meshes }) {
    const jolt = make_system(), system = jolt.GetPhysicsSystem(), bodies = system.GetBodyInterface();
    const gravity = new Jolt.Vec3(0, -settings.gravity, 0), up = new Jolt.Vec3(0, 1, 0);
    system.SetGravity(gravity);
    const all = [];
    const add = (shape, position, rotation, motion, layer) => {
        const made = new Jolt.BodyCreationSettings(shape, new Jolt.RVec3(...position), new Jolt.Quat(...rotation), motion, layer);
        const body = bodies.CreateBody(made);
        Jolt.destroy(made);
        shape.Release();
        bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
        all.push(body);
        return body;
    };
    const still = still_mesh(meshes);
    if (still.indices.length) add(mesh_shape(still), [0, 0, 0], [0, 0, 0, 1], Jolt.EMotionType_Static, still_layer);
    const movers = meshes.map((m) => m.moves ? add(mesh_shape(m), m.position, m.rotation, Jolt.EMotionType_Kinematic, moving_layer) : null);

    const standing = new Jolt.RotatedTranslatedShapeSettings(new Jolt.Vec3(0, height / 2, 0), new Jolt.Quat(0, 0, 0, 1), new Jolt.CapsuleShapeSettings(height / 2 - radius, radius)).Create().Get();
    const with_settings = new Jolt.CharacterVirtualSettings();
    with_settings.mMaxSlopeAngle = settings.max_slope_deg * Math.PI / 180;
    with_settings.mShape = standing;
    with_settings.mBackFaceMode = Jolt.EBackFaceMode_CollideWithBackFaces;
    with_settings.mSupportingVolume = new Jolt.Plane(up, -radius);
    const player = new Jolt.CharacterVirtual(with_settings, new Jolt.RVec3(...feet), new Jolt.Quat(0, 0, 0, 1), system);

    let sliding_allowed = false;
    const listener = new Jolt.CharacterContactListenerJS();
    for (const name of ['OnAdjustBodyVelocity', 'OnContactAdded', 'OnContactPersisted', 'OnContactRemoved', 'OnCharacterContactAdded', 'OnCharacterContactPersisted',
        'OnCharacterContactRemoved', 'OnCharacterContactSolve']) listener[name] = () => {};
    listener.OnContactValidate = listener.OnCharacterContactValidate = () => true;
    listener.OnContactSolve = (character, body, part, position, normal, velocity, material, own, result) => {
        const ground = Jolt.wrapPointer(velocity, Jolt.Vec3), n = Jolt.wrapPointer(normal, Jolt.Vec3), made = Jolt.wrapPointer(result, Jolt.Vec3);
        if (!sliding_allowed && ground.IsNearZero() && !player.IsSlopeTooSteep(n)) made.Set(0, 0, 0);
    };
    player.SetListener(listener);

    const update = new Jolt.ExtendedUpdateSettings();
    update.mWalkStairsStepUp = new Jolt.Vec3(0, settings.step_height, 0);
    update.mStickToFloorStepDown = new Jolt.Vec3(0, -settings.snap_distance, 0);
    const filters = [new Jolt.DefaultBroadPhaseLayerFilter(jolt.GetObjectVsBroadPhaseLayerFilter(), moving_layer),
        new Jolt.DefaultObjectLayerFilter(jolt.GetObjectLayerPairFilter(), moving_layer), new Jolt.BodyFilter(), new Jolt.ShapeFilter()];
    const velocity = new Jolt.Vec3(0, 0, 0), position = new Jolt.RVec3(0, 0, 0), rotation = new Jolt.Quat(0, 0, 0, 1);

    return {
        step({ dt, wish, jump, poses }) {
            for (const pose of poses) {
                position.Set(...pose.position);
                rotation.Set(...pose.rotation);
                bodies.MoveKinematic(movers[pose.mesh].GetID(), position, rotation, dt);
            }
            player.UpdateGroundVelocity();
            const grounded = player.GetGroundState() === Jolt.EGroundState_OnGround, ground = player.GetGroundVelocity(), old = player.GetLinearVelocity();
            sliding_allowed = wish[0] !== 0 || wish[1] !== 0;
            let base = [0, old.GetY(), 0];
            if (grounded && old.GetY() - ground.GetY() < 0.1) base = [ground.GetX(), ground.GetY() + (jump ? settings.jump_speed : 0), ground.GetZ()];
            velocity.Set(base[0] + wish[0] * settings.walk_speed, base[1] - settings.gravity * dt, base[2] + wish[1] * settings.walk_speed);
            player.SetLinearVelocity(velocity);
            player.ExtendedUpdate(dt, gravity, update, ...filters, jolt.GetTempAllocator());
            jolt.Step(dt, 1);
            const now = player.GetPosition(), v = player.GetLinearVelocity();
            return { feet: [now.GetX(), now.GetY(), now.GetZ()], velocity: [v.GetX(), v.GetY(), v.GetZ()], grounded: player.GetGroundState() === Jolt.EGroundState_OnGround };
        },
        free() {
            Jolt.destroy(player);
            for (const body of all) {
                bodies.RemoveBody(body.GetID());
                bodies.DestroyBody(body.GetID());
            }
            Jolt.destroy(jolt);
        },
    };
}

serve({ engine: 'jolt', version: await package_version('jolt-physics'), features: ['slope_limit', 'steps', 'snap', 'moving', 'jump'], load });
