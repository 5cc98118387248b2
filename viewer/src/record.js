// Reads a record of a run (record.fram).  The layout stands in src/io/record.h (head and blocks) and
// src/io/record_layout.h (payloads); this file follows them and knows nothing of drawing.  Frames are found at once and
// decoded when they are shown.

const MAGIC = 'FRAMREC\n', BLOCK_MAGIC = 0x0a4b4c42; // 'BLK\n', little-endian
const SCENARIO = 1, SOLID = 2, DEATHS = 4, FRACTURES = 6, BIRTHS = 7, FORCES = 9, FRAME_BESIDE = 10;
const HALF_FRAME = 11, LOADS = 13, PRESSURE = 14, FRAME = 15, ORIGIN = 16;
const EARLIER = [3, 5, 8];
const MATERIALS = ['ice', 'hull', 'wall'];
const BREAKS = ['', 'split', 'bending', 'loose']; // enum fracture_kind; loose: a part of level ice
const HEAD = 24, POSE = 16, FRAME_HEAD = 48;
const MARKED = 32768; // of the last number of a pose: a contact force follows
const NEVER = Infinity;

/** The hulls, in the order of the vessels that take part. */
export const hullsOf = (record) => record.bodies.filter((b) => b.material === 'hull');

/** A mantissa of ten bits under an exponent, of which 0 has the numbers without a leading one; `last`: exponent of the
 *  last place of the smallest. */
function unpackSize(packed, last) {
    const field = packed >> 10;
    return ((packed & 1023) + (field ? 1024 : 0)) * 2 ** (Math.max(field, 1) - 1 + last);
}
/** Half floats of all 16-bit patterns, and contact forces [kN], which have no sign and a longer exponent. */
const HALF = Float32Array.from({ length: 65536 }, (_, h) => (h & 0x8000 ? -1 : 1) * unpackSize(h & 0x7fff, -24));
const CONTACT = Float32Array.from({ length: 65536 }, (_, force) => unpackSize(force, -40));
/** In frames of this type of block; of an earlier layout they are half floats. */
const contactsOf = (type) => (type === HALF_FRAME ? HALF : CONTACT);

/** A pose as src/io/record_pose.h packs it: x y z, then the unit quaternion as x y z w (the order of three.js).
 *  @returns whether it is marked: in a frame, a contact force follows. */
function unpackPose(view, at, out, to) {
    out[to] = view.getFloat32(at, true);
    out[to + 1] = view.getFloat32(at + 4, true);
    out[to + 2] = HALF[view.getUint16(at + 8, true)];
    const s = Math.SQRT1_2 / 16383;
    const w0 = view.getUint16(at + 10, true), w1 = view.getUint16(at + 12, true), w2 = view.getUint16(at + 14, true);
    const a = ((w0 & 32767) - 16383) * s, b = ((w1 & 32767) - 16383) * s, c = ((w2 & 32767) - 16383) * s;
    const d = Math.sqrt(Math.max(0, 1 - a * a - b * b - c * c)), largest = w0 >> 15 << 1 | w1 >> 15;
    // In the order w x y z the largest one is left out.
    if (largest === 0) { out[to + 6] = d; out[to + 3] = a; out[to + 4] = b; out[to + 5] = c; }
    else if (largest === 1) { out[to + 6] = a; out[to + 3] = d; out[to + 4] = b; out[to + 5] = c; }
    else if (largest === 2) { out[to + 6] = a; out[to + 3] = b; out[to + 4] = d; out[to + 5] = c; }
    else { out[to + 6] = a; out[to + 3] = b; out[to + 4] = c; out[to + 5] = d; }
    return w2 >= MARKED;
}

/** Walks a DataView from front to back. */
class Cursor {
    constructor(view, offset) { this.view = view; this.at = offset; }
    u8() { return this.view.getUint8(this.at++); }
    i32() { this.at += 4; return this.view.getInt32(this.at - 4, true); }
    u32() { this.at += 4; return this.view.getUint32(this.at - 4, true); }
    i64() { this.at += 8; return Number(this.view.getBigInt64(this.at - 8, true)); }
    f32() { this.at += 4; return this.view.getFloat32(this.at - 4, true); }
    f64() { this.at += 8; return this.view.getFloat64(this.at - 8, true); }
    vec3() { return [this.f32(), this.f32(), this.f32()]; }
    pose() {
        const out = new Float32Array(7);
        unpackPose(this.view, this.at, out, 0);
        this.at += POSE;
        return out;
    }
}

/** @returns {{scenario: string, origin: number[], bodies: Body[], frames: Frame[], fractures: Fracture[]}}
 *  All places are from the origin, [x, y] in global coordinates: what is drawn stays near 0, where floats are fine.
 *  Body: {index, slot, material, moves, birth, death (frame numbers; death is the first frame without it), number and
 *  parent of a floe, thickness, area, outline [[x, y], ...] and level (a tile of level ice) of a prism, or vertices and
 *  triangles of a solid, pose of a body that does not move}.
 *  Frame: {time, step, force: [x, y, z], order: bodies that move, view and at of its poses with contacts, the table of
 *  their contact forces, or chunk and offset of a file beside the page}.
 *  Fracture: {time, kind, floe, place, load}.
 *  loads (told of vessels, src/results/playback_explained.c) and pressure (on a hull) of pages that have them. */
export function readRecord(buffer) {
    const reader = new RecordReader();
    reader.append(buffer);
    if (!reader.record.frames.length) throw new Error('the record holds no frames (output.frame_interval is 0?)');
    return reader.record;
}

/** Reads a record that grows: whole blocks are taken as they come, the beginning of one waits for the rest. */
export class RecordReader {
    constructor() {
        this.record = { scenario: '', origin: [0, 0], bodies: [], frames: [], fractures: [] };
        this.state = { record: this.record, alive: new Map(), order: null };
        this.rest = new ArrayBuffer(0);
        this.headed = false;
    }

    append(buffer) {
        const whole = this.rest.byteLength ? joined(this.rest, buffer) : buffer, view = new DataView(whole);
        this.rest = whole;
        if (!this.headed && !this.readHead(view)) return;
        // Forces belong to the frame after them: they wait for it, so that both lie in one piece of memory.
        let good = this.start;
        eachBlock(view, this.start, (type, at, size) => {
            readBlock(this.state, type, new Cursor(view, at), whole, size);
            if (type !== FORCES) good = at + padded(size);
        });
        this.state.forces = undefined;
        this.rest = whole.slice(good);
        this.start = 0;
    }

    readHead(view) {
        if (view.byteLength < HEAD) return false;
        if (text(view.buffer, 0, 8) !== MAGIC) throw new Error('this is not a record of Fram');
        if (view.getUint32(12, true) !== 0x01020304) throw new Error('the record was written with another byte order');
        this.headed = true;
        this.start = HEAD;
        return true;
    }
}

function joined(a, b) {
    const out = new Uint8Array(a.byteLength + b.byteLength);
    out.set(new Uint8Array(a));
    out.set(new Uint8Array(b), a.byteLength);
    return out.buffer;
}

/** Blocks begin at multiples of 8. */
function padded(size) { return Math.ceil(size / 8) * 8; }

/** Calls visit(type, start of payload, size) until the end, a cut block, or a visit that returns true. */
function eachBlock(view, at, visit) {
    while (at + HEAD <= view.byteLength && view.getUint32(at, true) === BLOCK_MAGIC) {
        const type = view.getUint32(at + 4, true), size = Number(view.getBigUint64(at + 8, true));
        // Cut short, be it in the zeros after the payload: what came before is good.
        if (at + HEAD + padded(size) > view.byteLength) return;
        if (visit(type, at + HEAD, size)) return;
        at += HEAD + padded(size);
    }
}

function text(buffer, at, size) { return new TextDecoder().decode(new Uint8Array(buffer, at, size)); }

function readBlock(state, type, c, buffer, size) {
    const { record } = state;
    switch (type) {
    case SCENARIO: record.scenario = text(buffer, c.at, size); break;
    case ORIGIN: record.origin = [c.f64(), c.f64()]; break;
    case SOLID: addBody(state, readSolid(c)); break;
    case BIRTHS: for (let n = c.i32(); n > 0; n--) addBody(state, readPrism(c)); break;
    case DEATHS: for (let n = c.i32(); n > 0; n--) removeBody(state, c.i32()); break;
    case FRACTURES: for (let n = c.i32(), k = c.i32(); k < n; k++) record.fractures.push(readFracture(c)); break;
    case FORCES: state.forces = c.at; break;
    case FRAME:
    case HALF_FRAME:
        addFrame(state, c, { view: c.view, forces: state.forces ?? -1, contacts: contactsOf(type) });
        break;
    case LOADS: record.loads = JSON.parse(text(buffer, c.at, size)); break;
    case PRESSURE: record.pressure = readPressure(c); break;
    case FRAME_BESIDE: addFrame(state, c, { chunk: c.i32(), offset: c.i32() }); break;
    case EARLIER[0]:
    case EARLIER[1]:
    case EARLIER[2]: throw new Error('an earlier version of Fram wrote it; run the scenario again');
    }
}

function addBody(state, body) {
    const { record, alive } = state;
    body.index = record.bodies.length;
    body.birth = record.frames.length;
    body.death = NEVER;
    record.bodies.push(body);
    alive.set(body.slot, body);
    state.order = null;
}

function removeBody(state, slot) {
    const body = state.alive.get(slot);
    if (body) body.death = state.record.frames.length;
    state.alive.delete(slot);
    state.order = null;
}

function readSolid(c) {
    const body = { slot: c.i32(), generation: c.u32(), material: 'hull', moves: true, number: -1, parent: -1 };
    const vertices = c.i32(), triangles = c.i32();
    body.vertices = Float32Array.from({ length: 3 * vertices }, () => c.f32());
    body.triangles = Uint32Array.from({ length: 3 * triangles }, () => c.i32());
    return body;
}

function readPrism(c) {
    const body = { slot: c.i32(), generation: c.u32(), material: MATERIALS[c.u8()], moves: c.u8() !== 0 };
    body.breakable = c.u8() !== 0;
    body.level = c.u8() !== 0;
    body.thickness = c.f32();
    body.density = c.f32();
    body.number = c.i32();
    body.parent = c.i32();
    body.outline = Array.from({ length: c.i32() }, () => [c.f32(), c.f32()]);
    if (!body.moves) body.pose = c.pose();
    const ring = body.outline;
    body.area = ring.reduce((sum, [x, y], i) => {
        const [u, v] = ring[(i + 1) % ring.length];
        return sum + (x * v - u * y) / 2;
    }, 0);
    body.radius = Math.max(...ring.map(([x, y]) => Math.hypot(x, y)));
    return body;
}

function readFracture(c) {
    const f = { time: c.f64(), kind: BREAKS[c.i32()], floe: c.i32(), pieces: c.i32() };
    c.i32();
    return { ...f, place: c.vec3(), load: c.f32(), crack: c.f32(), area: c.f32() };
}

function readPressure(c) {
    c.at += 64; // the hash of the scenario
    const told = { from: c.f64(), to: c.f64(), vessel: c.i32() }, panels = c.i32(), triangles = c.i32();
    c.i32();
    told.mean = new Float32Array(panels);
    told.largest = new Float32Array(panels);
    told.when = new Float32Array(panels);
    for (let i = 0; i < panels; i++) { told.mean[i] = c.f32(); told.largest[i] = c.f32(); told.when[i] = c.f32(); }
    told.panel = Uint32Array.from({ length: triangles }, () => c.i32());
    told.corner = Float32Array.from({ length: 9 * triangles }, () => c.f32());
    return told;
}

/** Poses come by ascending slot of the bodies that move; frames with no birth or death between share
 *  their order. */
function addFrame(state, c, place) {
    const { record, alive } = state;
    const frame = { number: record.frames.length, step: c.i64(), time: c.f64(), force: [c.f64(), c.f64(), c.f64()] };
    const count = c.i32();
    c.i32();
    state.forces = undefined;
    state.order ??= Uint32Array.from([...alive.values()].filter((b) => b.moves).sort((a, b) => a.slot - b.slot),
        (b) => b.index);
    if (state.order.length !== count)
        throw new Error(`frame at ${frame.time} s has ${count} poses for ${state.order.length} bodies`);
    record.frames.push(Object.assign(frame, place, { order: state.order, at: c.at }));
}

/** What a frame holds, decoded: {poses: 7 numbers each in its order, contact: kN each, forces}, or null while the file
 *  with it is on its way. */
export class FrameStore {
    constructor(record, chunks) {
        this.record = record;
        this.chunks = chunks;
        this.kept = new Map();
    }

    get(number) {
        const found = this.kept.get(number);
        if (found) return found;
        const frame = this.record.frames[number];
        const decoded = frame.view ? decode(frame, frame) : this.fromChunk(frame);
        if (!decoded) return null;
        if (this.kept.size >= 4) this.kept.delete(this.kept.keys().next().value);
        this.kept.set(number, decoded);
        return decoded;
    }

    fromChunk(frame) {
        const view = this.chunks.get(frame.chunk);
        if (!view) return null;
        const place = { view, at: -1, forces: -1 };
        eachBlock(view, frame.offset, (type, start) => {
            if (type === FORCES) place.forces = start;
            if (type !== FRAME && type !== HALF_FRAME) return false;
            place.at = start + FRAME_HEAD;
            place.contacts = contactsOf(type);
            return true;
        });
        return decode(place, frame);
    }
}

function decode({ view, at, forces, contacts }, frame) {
    const count = frame.order.length, poses = new Float32Array(7 * count), contact = new Float32Array(count);
    for (let i = 0; i < count; i++, at += POSE) {
        if (!unpackPose(view, at, poses, 7 * i)) continue;
        contact[i] = contacts[view.getUint16(at + POSE, true)];
        at += 2;
    }
    return { poses, contact, forces: forces < 0 ? [] : readForces(new Cursor(view, forces)) };
}

const KINDS = ['', 'ice', 'line', 'thruster', 'hull'];
function readForces(c) {
    const count = c.i32();
    c.i32();
    return Array.from({ length: count }, () => (
        { kind: KINDS[c.i32() & 255], which: c.i32(), point: c.vec3(), force: c.vec3() }));
}

/** Contact forces of floes [kN] and forces on vessels [N] of all frames that are in the page, one by one, and the kinds
 *  of the latter. Reads past the poses. Where none of them meets ice, frames in files beside tell by their load. */
export function forcesOf({ bodies, frames }) {
    const touched = [], pulls = [], kinds = new Set();
    for (const { view, at, order, forces, contacts } of frames) {
        if (!view) continue;
        for (let i = 0, pose = at; i < order.length; i++, pose += POSE) {
            if (view.getUint16(pose + POSE - 2, true) < MARKED) continue;
            if (bodies[order[i]].material === 'ice') touched.push(contacts[view.getUint16(pose + POSE, true)]);
            pose += 2;
        }
        for (const { kind, force } of forces < 0 ? [] : readForces(new Cursor(view, forces))) {
            pulls.push(Math.hypot(...force));
            kinds.add(kind);
        }
    }
    const loads = frames.map(({ view, force }) => (view ? 0 : Math.hypot(...force))).filter((load) => load > 0);
    if (!kinds.has('ice') && loads.length) {
        pulls.push(...loads);
        touched.push(...loads.map((load) => load / 1000));
        kinds.add('ice');
    }
    return { contacts: touched, pulls, kinds };
}

const KEPT = 4; // files beside the page that are held at once

/** Files beside the page, each a script that calls framChunk(number, base64): scripts load from disk, where fetching is
 *  forbidden.  The next one is asked for ahead of time.  arrived() is called with each, failed(name) once for one that
 *  is not there or brings nothing. */
export class Chunks {
    constructor(folder, count, arrived, failed) {
        this.folder = folder;
        this.count = count;
        this.failed = failed;
        this.kept = new Map();
        this.asked = new Set();
        this.lost = new Set(); // asked for in vain: never again
        this.awaited = new Map(); // by number: calls that wait for load()
        window.framChunk = (number, base64) => {
            if (this.kept.size >= KEPT) this.kept.delete(this.kept.keys().next().value);
            this.kept.set(number, new DataView(bytesOf(base64)));
            this.asked.delete(number);
            arrived();
            this.settle(number, true);
        };
    }

    /** @returns {Promise<boolean>} true once the file is here; false when it is missing. */
    load(number) {
        if (this.kept.has(number) || this.lost.has(number)) return Promise.resolve(this.kept.has(number));
        return new Promise((done) => {
            this.awaited.set(number, [...this.awaited.get(number) ?? [], done]);
            this.ask(number);
        });
    }

    settle(number, there) {
        for (const done of this.awaited.get(number) ?? []) done(there);
        this.awaited.delete(number);
    }

    get(number) {
        const view = this.kept.get(number);
        if (!view) {
            this.ask(number);
            return undefined;
        }
        this.kept.delete(number); // the last one used is the last to go
        this.kept.set(number, view);
        if (number + 1 < this.count) this.ask(number + 1);
        return view;
    }

    ask(number) {
        if (this.asked.has(number) || this.kept.has(number) || this.lost.has(number)) return;
        const script = document.createElement('script'), name = `${String(number).padStart(4, '0')}.js`;
        script.src = `${this.folder}/${name}`;
        script.onload = script.onerror = () => {
            script.remove();
            if (!this.asked.delete(number)) return; // it has come
            this.lost.add(number);
            this.failed(`${decodeURIComponent(this.folder)}/${name}`);
            this.settle(number, false);
        };
        this.asked.add(number);
        document.head.append(script);
    }
}

export function bytesOf(base64) {
    const binary = atob(base64.trim()), bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
    return bytes.buffer;
}
