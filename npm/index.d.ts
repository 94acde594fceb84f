/**
 * Character movement for 3D games: a swept ellipsoid against triangles, with stairs, slopes, moving platforms, ladders, ice,
 * jump-through floors and crowds. Metres, seconds, radians; +Y up, right-handed, as in three.js.
 *
 * ```js
 * import { load, World, Settings, Character } from "slipface";
 * await load();
 * const world = World.fromGeometry(mesh.geometry, { matrix: mesh.matrixWorld });
 * const player = new Character(world, new Settings("platformer"), { x: 0, y: 1, z: 0 });
 * // 60 times per second:
 * player.step({ x: right - left, z: back - forward, jump }, 1 / 60);
 * mesh.position.copy(player.position);
 * ```
 *
 * What is wrong throws a {@link SlipfaceError} that says what was found and what was expected, and changes nothing. Worlds,
 * settings and characters free their memory when they are collected; `dispose()` frees it at once. The same calls give the same
 * bits on every machine, in every browser and in the native library.
 */

export interface Vec3 {
    x: number;
    y: number;
    z: number;
}
export interface Quaternion extends Vec3 {
    w: number;
}

/** What was found and what was expected. */
export class SlipfaceError extends Error {}

/**
 * Loads `mover.wasm`, from beside the module unless told otherwise: an address, a `Response`, its bytes or a
 * `WebAssembly.Module`. Await it before everything else. Later calls return the first one's promise.
 */
export function load(source?: string | URL | Response | Promise<Response> | ArrayBuffer | ArrayBufferView | WebAssembly.Module): Promise<void>;

/** Bits of {@link Input.buttons}. Bits from 8 on are a game's own. */
export const Button: Readonly<{ jump: 1; crouch: 2; dash: 4; grab: 8; drop: 16 }>;

/** Triangles as typed arrays, which are copied. */
export interface Mesh {
    /** x, y and z of each corner, m. */
    positions: Float32Array;
    /** Three per triangle, counter-clockwise seen from the front. Without it the corners are used in their order. */
    indices?: Uint32Array | Uint16Array | null;
    /** The surface type of each triangle; all are 0, `default`, without it. */
    types?: Uint8Array | null;
    /** The groups of each triangle, one bit each; without it each is in all groups. See {@link Filter}. */
    groups?: Uint32Array | null;
}
/** A `THREE.BufferGeometry`, or Babylon's `VertexData`. */
export type Geometry =
    | { attributes: { position: { count: number; getX(i: number): number; getY(i: number): number; getZ(i: number): number } }; index: { array: ArrayLike<number> } | null }
    | { positions: ArrayLike<number>; indices?: ArrayLike<number> | null };
/** A `THREE.Matrix4`, or 16 numbers, column by column. */
export type Matrix = { elements: ArrayLike<number> } | ArrayLike<number>;

/** Several meshes as one for `new World()`. Each has a type and groups for all of its triangles. */
export function merge(meshes: Array<(Mesh | Geometry | { geometry: Geometry }) & { matrix?: Matrix; type?: number; groups?: number }>): Required<Mesh>;

/** What a query sees and a character meets. Everything without one. */
export interface Filter {
    /** What has one of these groups is met. */
    mask?: number;
    /** Of the character itself, for the masks of other characters. */
    groups?: number;
    /** Surface types that are not met. */
    ignoredTypes?: Iterable<number>;
    /**
     * Asked last: whether a triangle is met. It must answer the same during a call, and not call slipface. `platform` is null
     * for what does not move.
     */
    sees?(platform: number | null, triangle: number): boolean;
}

interface Disposable {
    /** Frees the memory. Later uses throw. A second call does nothing. */
    dispose(): void;
    readonly disposed: boolean;
}

export interface SettingInfo {
    name: string;
    label: string;
    group: string;
    /** "m/s", "deg" (shown; the value is in radians), "". */
    unit: string;
    meaning: string;
    minimum: number;
    maximum: number;
    initial: number;
    kind: "switch" | "whole" | "number" | "choice";
}

/** How a character moves, by {@link Settings.list}. Several characters may share them. */
export class Settings implements Disposable {
    /** "platformer" (the defaults), "lecture", "precise-platformer", "momentum" or "simulation", and changes to it. */
    constructor(preset?: string | null, changes?: Record<string, number | boolean | string>);
    constructor(changes: Record<string, number | boolean | string>);
    /** Changes one: a number, a switch as a boolean, or text, as "50deg" or a choice's name. */
    set(name: string, value: number | boolean | string): this;
    /** A switch is 0 or 1, a choice its index. */
    get(name: string): number;
    /** Of the body, an ellipsoid: `radius_x`, `radius_y`, `radius_z`, m. */
    readonly radii: Vec3;
    /** All settings, for a property sheet. */
    static list(): SettingInfo[];
    dispose(): void;
    readonly disposed: boolean;
}

/** Parameters of a surface type. */
export interface TypeParameters {
    /** How well the ground holds: 1 as plain ground, 0 slides. */
    friction?: number;
    /** The fraction of the speed into it that a bounce gives back, 0 to 1. */
    restitution?: number;
    /** Slides without loss: ice. */
    keeps_energy?: boolean;
    /** A ladder. */
    climbable?: boolean;
    climb_speed?: number;
    /** Holds what touches it until a jump. */
    sticky?: boolean;
    /** m/s, of what stands on it: a conveyor belt. */
    velocity?: Vec3;
    /** rad/s about +Y through `spin_centre`: a turntable. */
    angular_velocity?: number;
    spin_centre?: Vec3;
    /** Stops what comes from its front alone: jump-through floors. */
    one_sided?: boolean;
    /** false: a trigger. It stops nothing and reports who enters and leaves. */
    solid?: boolean;
    /** Touching it sets {@link Character.hazard}. */
    hazardous?: boolean;
    /** Radians, instead of the settings' `max_slope`. */
    max_slope?: number;
}

export interface Contact {
    /** Fraction of the move, 0 to 1. */
    t: number;
    /** On the triangle. */
    point: Vec3;
    /** Unit, towards the body. */
    normal: Vec3;
    triangle: number;
    face: number;
    /** The surface type. */
    type: number;
    /** null: what does not move. */
    platform: number | null;
    feature: "interior" | "edge" | "vertex";
}
/** A contact of a step. */
export interface StepContact extends Omit<Contact, "t"> {
    /** m/s, at which body and face approached each other along the normal. */
    speed: number;
    /** "push": a platform that pushes; "step up" and "snap": where those ended. */
    pass: "slide" | "horizontal" | "vertical" | "push" | "step up" | "snap";
}
export interface StepEvent {
    /**
     * `landed` (value: m/s into the ground), `left` the ground (value: m/s upwards), `touched` a type other than 0 (value: m/s),
     * `hazard`, `stepped` up (value: m), `crushed`; a trigger was `entered`, `stayed` in or `departed` from.
     */
    kind: "landed" | "left" | "touched" | "hazard" | "stepped" | "crushed" | "entered" | "stayed" | "departed";
    type: number;
    platform: number | null;
    face: number | null;
    value: number;
}
export interface RayHit {
    /** In lengths of the direction. */
    t: number;
    point: Vec3;
    normal: Vec3;
    triangle: number;
    face: number;
    platform: number | null;
    /** From behind. */
    back: boolean;
}
export interface ClosestPoint {
    distance: number;
    point: Vec3;
    triangle: number;
    face: number;
    platform: number | null;
}
export interface Overlap {
    point: Vec3;
    normal: Vec3;
    depth: number;
    triangle: number;
    face: number;
    type: number;
    platform: number | null;
}

/** What is collided with: triangles that stand still, and platforms. Triangle i is face i. */
export class World implements Disposable {
    /** Types 0 to 7 are default, ice, ladder, sticky, bouncy, conveyor, turntable and hazard. */
    constructor(mesh: Mesh | Geometry);
    static fromGeometry(geometry: Geometry, options?: { matrix?: Matrix; type?: number; groups?: number }): World;
    readonly bounds: { lowest: Vec3; highest: Vec3; triangles: number };

    /** The number of a surface type, or null. */
    type(name: string): number | null;
    /** A new type that behaves as `default` but for its parameters. At most 255. */
    addType(name: string, parameters?: TypeParameters): number;
    setType(type: number, parameters: TypeParameters): void;
    /** Of what does not move. */
    setFaceType(face: number, type: number): void;
    /** A door that opens for one team, a floor that a player drops through: see {@link Filter.mask}. */
    setFaceGroups(face: number, groups: number, platform?: number | null): void;

    /** A platform, by its number. It stands as given until it is moved. */
    addPlatform(mesh: Mesh | Geometry, matrix?: Matrix): number;
    /**
     * The platform goes from where it is to `position` and `rotation` within the next step of `dt`. Once that step was made, call
     * it again, also for a platform that stays.
     */
    movePlatform(platform: number, position: Vec3, rotation: Quaternion | null | undefined, dt: number): void;

    /** The first contact of an ellipsoid that moves. */
    sweep(radii: Vec3, from: Vec3, move: Vec3, filter?: Filter | null): Contact | null;
    /** The first triangle with t from 0 to `maxT`, in lengths of the direction. */
    ray(origin: Vec3, direction: Vec3, maxT?: number, filter?: Filter | null): RayHit | null;
    closestPoint(point: Vec3, maxDistance?: number, filter?: Filter | null): ClosestPoint | null;
    /** The triangles that an ellipsoid at rest overlaps, at most 64. */
    overlaps(radii: Vec3, centre: Vec3, filter?: Filter | null): Overlap[];
    dispose(): void;
    readonly disposed: boolean;
}

export interface Input {
    /** Wanted velocity as a fraction of the walking speed; longer than 1 counts as 1. */
    x?: number;
    z?: number;
    /** The button is held. */
    jump?: boolean;
    /** Bits of {@link Button}. */
    buttons?: number;
}

/** A player, or anything that walks. */
export class Character implements Disposable {
    /** At rest with its centre there. */
    constructor(world: World, settings: Settings, position: Vec3);
    world: World;
    settings: Settings;
    /** What it meets; everything without one. */
    filter: Filter | null | undefined;

    /** Moves it by one step of `dt` seconds, 1/60 for example: 0.0001 and more. */
    step(input: Input | null | undefined, dt: number): this;
    /** The centre of the body. Each read makes a new object. */
    readonly position: Vec3;
    /** m/s, relative to what carries it, and on the ground with what presses it down: see `motion`. */
    readonly velocity: Vec3;
    /** m/s, of its own motion: for animation and displays. */
    readonly motion: Vec3;
    readonly grounded: boolean;
    readonly climbing: boolean;
    readonly stuck: boolean;
    /** Touched a hazardous surface in this step. */
    readonly hazard: boolean;
    readonly trapped: boolean;
    /** By a platform that left no room, in this step. */
    readonly crushed: boolean;
    /** What it stands on. */
    readonly ground: { normal: Vec3; face: number | null; platform: number | null; type: number } | null;
    /** Of the last step, in order, at most 16. */
    readonly contacts: StepContact[];
    /** Of the last step, at most 16. */
    readonly events: StepEvent[];

    /** All that a step knows of it. `restore(save())` and the same inputs give the same bits: rollback. */
    save(): Uint8Array;
    restore(saved: Uint8Array): this;
    /** A teleport: to the nearest free place at most `farthest` metres away. false: there is none, and nothing changed. */
    putAt(position: Vec3, farthest?: number): boolean;
    /** To crouch, to stand up: the settings with other radii, the feet where they are. false: there is no room. */
    changeBody(settings: Settings): boolean;
    dispose(): void;
    readonly disposed: boolean;
}

/** One step of characters of one world that push each other and stand on each other. The order changes no bit. */
export function stepCrowd(characters: Character[], inputs: Array<Input | null | undefined>, dt: number): void;
