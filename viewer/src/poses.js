// Where every body is at a moment between two frames: tables that the drawing reads.

const STILL = [0, 0, 0];

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
        this.places = [new Places(n), new Places(n)]; // of a way between two frames
        this.ends = null;
        this.frame = -1;
        this.floes = this.tiles = 0; // that are there: floes, and tiles of level ice
        for (const b of record.bodies) if (b.pose) this.pose.set(b.pose, 7 * b.index);
        this.numbered = new Map(record.bodies.filter((b) => b.number >= 0).map((b) => [b.number, b]));
    }

    /** Whether the file with a frame is asked for in vain. */
    isLost(f) { return this.store.chunks.lost.has(this.record.frames[f]?.chunk); }

    /** Go to a frame number with a fraction; false when the frames are not there yet.  Speeds are of the way to the
     *  next frame; a body that is not in it goes on as endsOf says.  Without `ends` it rests, and no frame is asked for
     *  to tell how it goes on.  A frame beside files that are lost is as one at an end of the run. */
    show(when, ends = true) {
        const { frames, bodies } = this.record;
        const last = frames.length - 1, f = Math.min(Math.floor(when), last);
        const g = f === last || when === f && this.isLost(f + 1) ? f : f + 1;
        const one = this.store.get(f), two = this.store.get(g);
        this.wanted = one && two ? [] : [f, g];
        const end = ends && !this.wanted.length ? this.endsOf(f, g) : new Map();
        if (this.wanted.length) return null;
        const part = when - f, a = frames[f], b = frames[g], place = this.later.of(b.order);
        const span = b.time - a.time || 1, since = part * (b.time - a.time);
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
            const k = a.order[i], j = f === g ? -1 : place[k];
            this.contact[k] = one.contact[i];
            if (j < 0) {
                const velocity = end.get(k) ?? STILL;
                goOn(P, 7 * i, velocity, since, out, 7 * k);
                this.speed[k] = Math.hypot(velocity[0], velocity[1]);
            } else {
                blend(P, 7 * i, Q, 7 * j, part, out, 7 * k);
                this.speed[k] = way(P, 7 * i, Q, 7 * j) / span;
            }
        }
        this.forces = part < 0.5 ? one.forces : two.forces;
        this.forcesAt = part < 0.5 ? [P, a.order] : [Q, b.order];
        const force = a.force.map((v, i) => v + part * (b.force[i] - v));
        return { time: a.time + part * (b.time - a.time), force, frame: f };
    }

    /** Velocities [m/s] by body of those of frame f that have no place in frame g, as in src/results/replay.c: of a
     *  tile of level ice that of its sheet, of a floe that of its way from the frame before, and of one that was not
     *  there that of what it broke from or, where no frame has that, of a sheet that drifts.  Frames that are on their
     *  way are `wanted`. */
    endsOf(f, g) {
        const { frames, bodies } = this.record, ends = new Map();
        if (f < g && frames[f].order === frames[g].order) return ends;
        if (this.ends?.f === f && this.ends.g === g) return this.ends.ends;
        for (const k of frames[f].order) {
            const velocity = f < g && bodies[k].death !== g ? null : this.lastVelocity(bodies[k], f);
            if (velocity) ends.set(k, velocity);
            if (this.wanted.length) return ends;
        }
        this.ends = { f, g, ends };
        return ends;
    }

    /** Of a body that is not in the frame after f.  It broke from bodies as short-lived as long as their frames are no
     *  more than a file away: not more files are asked for than are held at once. */
    lastVelocity(body, f) {
        const { frames } = this.record;
        for (let b = body, at = f; b?.moves && !(frames[at - 1]?.chunk < frames[f].chunk - 1); at--) {
            const sheet = b.level ? this.velocity(this.tileOf(at), at, at + 1) : null;
            if (sheet || b.birth < at) return sheet ?? this.velocity(b, at - 1, at);
            b = this.numbered.get(b.parent);
            if (!b) return this.velocity(this.tileOf(at), at, at + 1);
        }
        return null;
    }

    /** Of a sheet that drifts as one: any tile that both this frame and the next one have. */
    tileOf(f) { return this.record.bodies.find((b) => b.level && b.moves && b.birth <= f && b.death > f + 1); }

    /** Of a body on its way from one frame to the next; null where there is none. */
    velocity(body, from, to) {
        const { frames } = this.record;
        if (!body || from < 0 || to >= frames.length || this.isLost(from) || this.isLost(to)) return null;
        const a = this.store.get(from), b = this.store.get(to);
        if (!a || !b) {
            this.wanted.push(from, to);
            return null;
        }
        const [i, j] = [from, to].map((f, end) => this.places[end].of(frames[f].order)[body.index]);
        const span = frames[to].time - frames[from].time || 1;
        return i < 0 || j < 0 ? null : [0, 1, 2].map((axis) => (b.poses[7 * j + axis] - a.poses[7 * i + axis]) / span);
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

/** Place at a velocity after a time, unturned. */
function goOn(a, i, velocity, time, out, to) {
    for (let k = 0; k < 7; k++) out[to + k] = a[i + k] + (k < 3 ? velocity[k] * time : 0);
}

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
