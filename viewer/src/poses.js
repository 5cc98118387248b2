// Where every body is at a moment between two frames: a table of poses that the drawing reads.

/** Seven numbers a body (x y z, quaternion x y z w) and a flag; bodies that are not there are not shown. */
export class Poses {
    constructor(record) {
        this.record = record;
        this.pose = new Float32Array(7 * record.bodies.length);
        this.shown = new Uint8Array(record.bodies.length);
        this.speed = new Float32Array(record.bodies.length);
        // Place of each body in the order of each frame, filled when first needed.
        this.places = new Map();
        for (const b of record.bodies) if (b.pose) this.pose.set(b.pose, 7 * b.index);
    }

    placesOf(f) {
        const order = this.record.frames[f].order;
        if (!this.places.has(order)) {
            const last = this.places.size && [...this.places.values()].at(-1);
            const place = last && sameOrder(last.order, order) ? last.place : inverse(order, this.record.bodies.length);
            this.places.set(order, { order, place });
        }
        return this.places.get(order).place;
    }

    /** Frame number with a fraction. */
    show(when) {
        const { frames, bodies } = this.record;
        const last = frames.length - 1, f = Math.min(Math.floor(when), last), g = Math.min(f + 1, last);
        const part = when - f;
        const a = frames[f], b = frames[g], placeB = this.placesOf(g), span = b.time - a.time || 1;
        for (const body of bodies) this.shown[body.index] = body.birth <= f && f < body.death ? 1 : 0;
        for (let i = 0; i < a.order.length; i++) {
            const k = a.order[i], j = placeB[k], to = 7 * k;
            blend(a.poses, 7 * i, b.poses, j < 0 ? -1 : 7 * j, part, this.pose, to);
            this.speed[k] = j < 0 ? 0
                : Math.hypot(b.poses[7 * j] - a.poses[7 * i], b.poses[7 * j + 1] - a.poses[7 * i + 1]) / span;
        }
        const force = a.force.map((v, i) => v + part * (b.force[i] - v));
        return { time: a.time + part * (b.time - a.time), force, frame: f };
    }
}

function sameOrder(a, b) { return a.length === b.length && a.every((v, i) => v === b[i]); }

function inverse(order, count) {
    const place = new Int32Array(count).fill(-1);
    order.forEach((k, i) => { place[k] = i; });
    return place;
}

/** Positions on a straight line, quaternions on the shorter way, normalised. */
function blend(a, i, b, j, part, out, to) {
    if (j < 0) { out.set(a.subarray(i, i + 7), to); return; }
    for (let c = 0; c < 3; c++) out[to + c] = a[i + c] + part * (b[j + c] - a[i + c]);
    let dot = 0, n = 0;
    for (let c = 3; c < 7; c++) dot += a[i + c] * b[j + c];
    const sign = dot < 0 ? -1 : 1;
    for (let c = 3; c < 7; c++) { out[to + c] = a[i + c] + part * (sign * b[j + c] - a[i + c]); n += out[to + c] ** 2; }
    n = 1 / Math.sqrt(n || 1);
    for (let c = 3; c < 7; c++) out[to + c] *= n;
}
