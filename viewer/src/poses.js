// Where every body is at a moment between two frames: tables that the drawing reads.

/** Per body: pose (x y z, quaternion x y z w), shown or not, speed [m/s], contact force [kN]. */
export class Poses {
    constructor(record, store) {
        this.record = record;
        this.store = store;
        this.grow();
    }

    /** Tables for all bodies that there are now. */
    grow() {
        const { record } = this, n = record.bodies.length;
        this.pose = new Float32Array(7 * n);
        this.shown = new Uint8Array(n);
        this.speed = new Float32Array(n);
        this.contact = new Float32Array(n);
        this.forces = [];
        this.forcesAt = null; // poses and order of the frame that they are of
        this.later = new Places(n);
        this.earlier = new Places(n);
        this.frame = -1;
        this.floes = this.tiles = 0; // that are there: floes, and tiles of level ice
        for (const b of record.bodies) if (b.pose) this.pose.set(b.pose, 7 * b.index);
    }

    /** Whether a body that moves is in frame f and in none after it. */
    someEnd(f, g) {
        const { frames, bodies } = this.record;
        return f === g || frames[f].order !== frames[g].order && bodies.some((b) => b.moves && b.death === g);
    }

    /** Whether the file with a frame is asked for in vain. */
    isLost(f) { return this.store.chunks.lost.has(this.record.frames[f]?.chunk); }

    /** Go to a frame number with a fraction; false when the frames are not there yet.  Speeds are of the way to the
     *  next frame, of a body that is not in it of the way from the frame before (as in src/results/replay.c); without
     *  `ends` the latter are 0, and that frame is not asked for.  A frame beside files that are lost is as one at an
     *  end of the run. */
    show(when, ends = true) {
        const { frames, bodies } = this.record;
        const last = frames.length - 1, f = Math.min(Math.floor(when), last);
        const g = f === last || when === f && this.isLost(f + 1) ? f : f + 1;
        const e = ends && f > 0 && !this.isLost(f - 1) && this.someEnd(f, g) ? f - 1 : f;
        const zero = this.store.get(e), one = this.store.get(f), two = this.store.get(g);
        if (!zero || !one || !two) {
            this.wanted = [e, f, g];
            return null;
        }
        const part = when - f, a = frames[f], b = frames[g], place = this.later.of(b.order);
        const span = b.time - a.time || 1;
        if (f !== this.frame) {
            this.floes = this.tiles = 0;
            for (const body of bodies) {
                const there = body.birth <= f && f < body.death;
                this.shown[body.index] = there ? 1 : 0;
                if (there && body.material === 'ice') this[body.level ? 'tiles' : 'floes']++;
            }
            this.frame = f;
        }
        const P = one.poses, Q = two.poses, out = this.pose;
        for (let i = 0; i < a.order.length; i++) {
            const k = a.order[i], j = place[k];
            blend(P, 7 * i, j < 0 ? P : Q, 7 * (j < 0 ? i : j), part, out, 7 * k);
            this.speed[k] = j < 0 ? 0 : way(P, 7 * i, Q, 7 * j) / span;
            this.contact[k] = one.contact[i];
        }
        if (e < f) this.endSpeeds(zero.poses, frames[e], P, a, f === g ? null : place);
        this.forces = part < 0.5 ? one.forces : two.forces;
        this.forcesAt = part < 0.5 ? [P, a.order] : [Q, b.order];
        const force = a.force.map((v, i) => v + part * (b.force[i] - v));
        return { time: a.time + part * (b.time - a.time), force, frame: f };
    }

    /** Of the bodies of a frame that have no place in the next one: by their way there from the frame before. */
    endSpeeds(before, from, poses, to, place) {
        const earlier = this.earlier.of(from.order), span = to.time - from.time || 1;
        for (let i = 0; i < to.order.length; i++) {
            const k = to.order[i];
            if (place && place[k] >= 0) continue;
            this.speed[k] = earlier[k] < 0 ? 0 : way(before, 7 * earlier[k], poses, 7 * i) / span;
        }
    }

    /** Of a body that moves, at the frame of the forces. */
    poseAtForces(index) {
        const [poses, order] = this.forcesAt, i = 7 * order.indexOf(index);
        return i < 0 ? this.pose.subarray(7 * index, 7 * index + 7) : poses.subarray(i, i + 7);
    }
}

/** Places of bodies in the order of a frame, -1: not there; kept until another order is asked for. */
class Places {
    constructor(count) {
        this.place = new Int32Array(count);
        this.order = null;
    }

    of(order) {
        if (this.order !== order) {
            this.place.fill(-1);
            for (let i = 0; i < order.length; i++) this.place[order[i]] = i;
            this.order = order;
        }
        return this.place;
    }
}

/** In plan [m]. */
function way(a, i, b, j) { return Math.hypot(b[j] - a[i], b[j + 1] - a[i + 1]); }

/** Positions on a straight line, quaternions on the shorter way, normalised. */
function blend(a, i, b, j, part, out, to) {
    out[to] = a[i] + part * (b[j] - a[i]);
    out[to + 1] = a[i + 1] + part * (b[j + 1] - a[i + 1]);
    out[to + 2] = a[i + 2] + part * (b[j + 2] - a[i + 2]);
    const s = a[i + 3] * b[j + 3] + a[i + 4] * b[j + 4] + a[i + 5] * b[j + 5] + a[i + 6] * b[j + 6] < 0 ? -1 : 1;
    const x = a[i + 3] + part * (s * b[j + 3] - a[i + 3]), y = a[i + 4] + part * (s * b[j + 4] - a[i + 4]);
    const z = a[i + 5] + part * (s * b[j + 5] - a[i + 5]), w = a[i + 6] + part * (s * b[j + 6] - a[i + 6]);
    const n = 1 / Math.sqrt(x * x + y * y + z * z + w * w || 1);
    out[to + 3] = x * n; out[to + 4] = y * n; out[to + 5] = z * n; out[to + 6] = w * n;
}
