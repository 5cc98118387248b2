// Reads a record of a run (record.fram).  The layout stands in src/io/record.h (head and blocks) and src/sim/recorder.h
// (payloads); this file follows them and knows nothing of drawing.

const MAGIC = 'FRAMREC\n', BLOCK_MAGIC = 0x0a4b4c42; // 'BLK\n', little-endian
const SCENARIO = 1, SOLID = 2, DEATHS = 4, BIRTHS = 7, FRAME = 8, EARLIER = [3, 5];
const MATERIALS = ['ice', 'hull', 'wall'];
const NEVER = Infinity;

/** Walks a DataView from front to back. */
class Cursor {
    constructor(view, offset) { this.view = view; this.at = offset; }
    u8() { return this.view.getUint8(this.at++); }
    u16() { this.at += 2; return this.view.getUint16(this.at - 2, true); }
    i32() { this.at += 4; return this.view.getInt32(this.at - 4, true); }
    u32() { this.at += 4; return this.view.getUint32(this.at - 4, true); }
    i64() { this.at += 8; return Number(this.view.getBigInt64(this.at - 8, true)); }
    f32() { this.at += 4; return this.view.getFloat32(this.at - 4, true); }
    f64() { this.at += 8; return this.view.getFloat64(this.at - 8, true); }
    half() {
        const h = this.u16(), field = h >> 10 & 31;
        return (h & 0x8000 ? -1 : 1) * ((h & 1023) + (field ? 1024 : 0)) * 2 ** (Math.max(field, 1) - 25);
    }
    /** Packed as src/sim/record_pose.h says: x y z, then the unit quaternion as x y z w (the order of three.js). */
    pose() {
        const out = [this.f32(), this.f32(), this.half()], word = [this.u16(), this.u16(), this.u16()];
        const largest = word[0] >> 15 << 1 | word[1] >> 15, part = [0, 0, 0, 0];
        let sum = 0;
        for (let i = 0, k = 0; i < 4; i++) {
            if (i === largest) continue;
            part[i] = ((word[k++] & 32767) - 16383) * Math.SQRT1_2 / 16383;
            sum += part[i] ** 2;
        }
        part[largest] = Math.sqrt(Math.max(0, 1 - sum));
        const [w, x, y, z] = part;
        return [...out, x, y, z, w];
    }
}

/** @returns {{scenario: string, bodies: Body[], frames: Frame[]}}
 *  Body: {slot, material, moves, birth, death (frame numbers; death is the first frame without it), thickness and
 *  outline [[x, y], ...] of a prism, or vertices and triangles of a solid, pose of a body that does not move}.
 *  Frame: {time, step, force: [x, y, z], poses: Float32Array, seven numbers for each of `bodies` that moves, in
 *  `order`}. */
export function readRecord(buffer) {
    const view = new DataView(buffer);
    if (buffer.byteLength < 24 || text(buffer, 0, 8) !== MAGIC) throw new Error('this is not a record of Fram');
    if (view.getUint32(12, true) !== 0x01020304) throw new Error('the record was written with another byte order');
    const record = { scenario: '', bodies: [], frames: [] };
    const alive = new Map(); // slot -> body
    let at = 24;
    while (at + 24 <= buffer.byteLength && view.getUint32(at, true) === BLOCK_MAGIC) {
        const type = view.getUint32(at + 4, true), size = Number(view.getBigUint64(at + 8, true));
        const begin = at + 24;
        if (begin + size > buffer.byteLength) break; // cut short: what came before is good
        readBlock(record, alive, type, new Cursor(view, begin), buffer, size);
        at = begin + Math.ceil(size / 8) * 8;
    }
    if (!record.frames.length) throw new Error('the record holds no frames (output.frame_interval is 0?)');
    return record;
}

function text(buffer, at, size) { return new TextDecoder().decode(new Uint8Array(buffer, at, size)); }

function readBlock(record, alive, type, c, buffer, size) {
    switch (type) {
    case SCENARIO: record.scenario = text(buffer, c.at, size); break;
    case SOLID: addBody(record, alive, readSolid(c)); break;
    case BIRTHS: for (let n = c.i32(); n > 0; n--) addBody(record, alive, readPrism(c)); break;
    case DEATHS: for (let n = c.i32(); n > 0; n--) removeBody(record, alive, c.i32()); break;
    case EARLIER[0]:
    case EARLIER[1]: throw new Error('an earlier version of Fram wrote it; run the scenario again');
    case FRAME: record.frames.push(readFrame(c, alive)); break;
    }
}

function addBody(record, alive, body) {
    body.index = record.bodies.length;
    body.birth = record.frames.length;
    body.death = NEVER;
    record.bodies.push(body);
    alive.set(body.slot, body);
}

function removeBody(record, alive, slot) {
    const body = alive.get(slot);
    if (body) body.death = record.frames.length;
    alive.delete(slot);
}

function readSolid(c) {
    const body = { slot: c.i32(), generation: c.u32(), material: 'hull', moves: true };
    const vertices = c.i32(), triangles = c.i32();
    body.vertices = Float32Array.from({ length: 3 * vertices }, () => c.f32());
    body.triangles = Uint32Array.from({ length: 3 * triangles }, () => c.i32());
    return body;
}

function readPrism(c) {
    const body = { slot: c.i32(), generation: c.u32(), material: MATERIALS[c.u8()], moves: c.u8() !== 0 };
    body.breakable = c.u8() !== 0;
    c.at += 1;
    body.thickness = c.f32();
    body.density = c.f32();
    body.number = c.i32();
    body.parent = c.i32();
    body.outline = Array.from({ length: c.i32() }, () => [c.f32(), c.f32()]);
    if (!body.moves) body.pose = c.pose();
    return body;
}

/** Poses come by ascending slot of the bodies that move. */
function readFrame(c, alive) {
    const frame = { step: c.i64(), time: c.f64(), force: [c.f64(), c.f64(), c.f64()] };
    const count = c.i32();
    c.i32();
    const moving = [...alive.values()].filter((b) => b.moves).sort((a, b) => a.slot - b.slot);
    if (moving.length !== count)
        throw new Error(`frame at ${frame.time} s has ${count} poses for ${moving.length} bodies`);
    frame.order = Uint32Array.from(moving, (b) => b.index);
    frame.poses = new Float32Array(7 * count);
    for (let i = 0; i < count; i++) {
        frame.poses.set(c.pose(), 7 * i);
        c.half();
    }
    return frame;
}

/** The scenario's title, from its YAML text. */
export function titleOf(record) {
    const line = record.scenario.match(/^title:\s*(.*)$/m);
    return line ? line[1].replace(/\s+#.*$/, '').replace(/^(["'])(.*)\1$/, '$2').trim() : '';
}
