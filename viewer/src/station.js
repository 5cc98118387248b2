// What holds and drives a vessel: mooring lines from their fairleads to their anchors, thrusters and propellers where
// they stand.
// Places come from the scenario in the record and from the forces of the frame at hand.
import * as THREE from 'three';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import { mergeGeometries } from 'three/examples/jsm/utils/BufferGeometryUtils.js';
import { Haloes } from './halo.js';
import { FORCE_COLOURS, GONE, HALO } from './legend.js';
import { hullsOf } from './record.js';
import { scenarioOf, sizesOf, vesselsOf } from './scenario.js';

const FREE = 16, SEGMENTS = FREE + 1; // of a line: those that hang, and one along the bottom
const DISC_PRESSURE = 45e3; // thrust on the disc of a propeller of full size without a diameter, as the keys say [Pa]
// Of propellers without keys, as src/sim/build_wash.c and src/sim/build_propulsion.c have them.
const SPACING = 1.5, DEPTH = 0.6, STERN = 0.45;
const LINE = 2; // width [px]
const LEAST_DISC = 0.025; // of the hull's length: smaller ones would not be seen

export class Station {
    /** water: its mesh, at whose edge lines are cut; haloes: what draws them. */
    constructor(scene, record, water, haloes) {
        const hulls = hullsOf(record);
        const told = scenarioOf(record), vessels = vesselsOf(told);
        this.sizes = sizesOf(told);
        const disc = (thrust) => Math.sqrt(4 * thrust / (Math.PI * DISC_PRESSURE * this.sizes.length));
        const each = (make) => vessels.flatMap((v, i) => (v.mode === 'free' && hulls[i] ? make(v, hulls[i]) : []));
        this.lines = each((v, hull) => linesOf(v, hull, record.origin));
        this.thrusters = each((v, hull) => [...thrustersOf(v, hull, disc), ...propellersOf(v, hull, disc)]);
        this.gone = 0; // lines that parted and thrusters that failed
        const box = new THREE.Box3().setFromObject(water);
        this.edge = [box.min, box.max];
        if (this.lines.length) this.addLines(scene);
        if (this.thrusters.length) this.addDiscs(scene, haloes);
    }

    /** Rows of swatches for the legend. */
    keys() {
        const names = [[true, 'propeller'], [false, 'thruster']]
            .filter(([own]) => this.thrusters.some((t) => Boolean(t.own) === own)).map(([, name]) => name);
        const drawn = [[this.lines, FORCE_COLOURS.line, 'mooring line'], [this.thrusters, FORCE_COLOURS.thruster,
            names.join(', ')]].filter(([list]) => list.length).map(([, colour, name]) => [colour, name]);
        return drawn.length ? [drawn, ...this.gone ? [[[GONE, 'parted or failed', true]]] : []] : [];
    }

    addLines(scene) {
        this.ends = new Float32Array(6 * SEGMENTS * this.lines.length);
        this.tints = new Float32Array(this.ends.length);
        const geometry = new LineSegmentsGeometry().setPositions(this.ends).setColors(this.tints);
        const over = { depthTest: false, transparent: true };
        this.drawnLines = overAll(new LineSegments2(geometry,
            new LineMaterial({ ...over, vertexColors: true, linewidth: LINE })), scene);
        const halo = new LineMaterial({ ...over, color: HALO, linewidth: LINE + 2 * Haloes.WIDTH });
        overAll(new LineSegments2(geometry, halo), scene).renderOrder = Haloes.under(this.drawnLines);
    }

    addDiscs(scene, haloes) {
        const blade = new THREE.BoxGeometry(0.18, 0.4, 0.04).rotateY(0.6).translate(0, 0.24, 0);
        const parts = [0, 1, 2, 3].map((k) => blade.clone().rotateZ(k * Math.PI / 2));
        parts.push(new THREE.TorusGeometry(0.5, 0.05, 6, 24), new THREE.CylinderGeometry(0.09, 0.09, 0.2, 8)
            .rotateX(Math.PI / 2));
        const material = new THREE.MeshBasicMaterial({ depthTest: false, transparent: true });
        this.discs = overAll(new THREE.InstancedMesh(mergeGeometries(parts), material, this.thrusters.length), scene);
        haloes.add(this.discs);
    }

    /** At the poses of the moment, with the forces of the frame next to it. */
    show(poses) {
        if (!this.lines.length && !this.thrusters.length) return;
        this.gone = 0;
        if (this.lines.length) this.showLines(poses);
        if (this.thrusters.length) this.showDiscs(poses);
    }

    showLines(poses) {
        const pulls = matched(this.lines, poses, 'line'), colour = new THREE.Color();
        this.lines.forEach((line, i) => {
            const pull = pulls.get(line);
            line.held = Boolean(pull);
            line.points = cut(pull ? this.held(line, pull, poses) : [line.foot, line.anchor], ...this.edge);
            this.gone += !pull;
            colour.set(pull ? FORCE_COLOURS.line : GONE);
            const drawn = pull ? strokes(line.points) : dashes(line.points[0], line.points.at(-1));
            for (let k = 0; k < SEGMENTS; k++) {
                const at = 6 * (SEGMENTS * i + k), [from, to] = drawn[k];
                from.toArray(this.ends, at);
                to.toArray(this.ends, at + 3);
                colour.toArray(this.tints, at);
                colour.toArray(this.tints, at + 3);
            }
        });
        const { instanceStart, instanceColorStart } = this.drawnLines.geometry.attributes;
        instanceStart.data.needsUpdate = instanceColorStart.data.needsUpdate = true;
    }

    /** Points of a line that pulls, from its upper end to its anchor. */
    held(line, pull, poses) {
        const { arm, anchor } = line, top = carried(pull.point.clone().sub(arm), line.hull, poses).add(arm);
        const way = new THREE.Vector2(anchor.x - top.x, anchor.y - top.y), level = way.length();
        if (!line.weight || !(level > 0)) return [top, anchor];
        const [x, y] = [way.x / level, way.y / level], { force } = pull;
        return hanging(Math.hypot(force.x, force.y), -force.z, line, level, top.z - anchor.z)
            .map(([far, deep]) => new THREE.Vector3(top.x + far * x, top.y + far * y, top.z - deep));
    }

    showDiscs(poses) {
        const found = matched(this.thrusters, poses, 'thruster'), matrix = new THREE.Matrix4();
        const turn = new THREE.Quaternion(), size = new THREE.Vector3(), front = new THREE.Vector3(0, 0, 1);
        const colour = new THREE.Color();
        this.thrusters.forEach((t, i) => {
            const push = t.own ?? found.get(t);
            if (t.own) t.place ??= astern(t, poses);
            else if (push) t.place = local(push.point, t.hull, poses); // where it stays when it fails
            t.works = Boolean(push);
            this.gone += !push;
            t.axis = push?.force?.length() > this.sizes.force ? push.force.clone().normalize()
                : turned(t.rest, t.hull, poses);
            t.at = t.place ? global(t.place, t.hull, poses) : null; // null: it had failed before the first frame
            matrix.compose(t.at ?? front, turn.setFromUnitVectors(front, t.axis), size.setScalar(t.at ? t.disc : 0));
            this.discs.setMatrixAt(i, matrix);
            this.discs.setColorAt(i, colour.set(push ? FORCE_COLOURS.thruster : GONE));
        });
        this.discs.instanceMatrix.needsUpdate = this.discs.instanceColor.needsUpdate = true;
    }
}

/** Seen through hull, ice and water, as the arrows are, and under these. */
function overAll(part, scene) {
    part.frustumCulled = false;
    part.renderOrder = 2;
    scene.add(part);
    return part;
}

// ---- from the scenario ----

const radians = (degrees) => degrees * Math.PI / 180;

/** Anchors lie where src/vessel/mooring.c puts them: from the vessel as it is put, before it begins where its lines
 *  balance; places from the origin of the record. */
function linesOf(v, hull, origin) {
    const { mooring: m } = v, c = Math.cos(radians(v.heading_deg)), s = Math.sin(radians(v.heading_deg));
    const centre = [v.x - origin[0] + c * m.x - s * m.y, v.y - origin[1] + s * m.x + c * m.y], out = [];
    for (const l of m.lines ?? []) {
        for (let k = 0; k < l.count; k++) {
            const angle = radians(l.direction_deg + k * l.spacing_deg), lead = [Math.cos(angle), Math.sin(angle)];
            const off = (by) => new THREE.Vector3(centre[0] + by * lead[0], centre[1] + by * lead[1], -m.depth);
            const arm = m.turret ? l.fairlead_distance : 0; // of a turret it keeps its direction
            out.push({
                hull, number: out.length + 1, distance: l.distance, anchor: off(l.fairlead_distance + l.distance),
                foot: off(l.fairlead_distance), arm: new THREE.Vector3(arm * lead[0], arm * lead[1], 0),
                weight: l.kind === 'catenary' ? l.weight : 0, stiffness: l.stiffness,
            });
        }
    }
    return out;
}

function reachOf(hull) {
    return hull.vertices.reduce(([a, b], x, i) => (i % 3 ? [a, b] : [Math.min(a, x), Math.max(b, x)]),
        [Infinity, -Infinity]);
}

/** Of both ways that it pushes [N]; an azimuth pushes one way alone. */
function largestThrust({ kind, thrust, thrust_astern: back }) {
    return kind !== 'azimuth' && back > 0 ? Math.max(thrust, back) : thrust;
}

/** disc(thrust): diameter of a propeller without one of its own. */
function thrustersOf(v, hull, disc) {
    const [stern, stem] = reachOf(hull);
    return (v.thrusters ?? []).map((t, i) => ({
        hull, number: i + 1, given: [t.x, t.y],
        rest: new THREE.Vector3(t.kind === 'tunnel' ? 0 : 1, t.kind === 'tunnel' ? 1 : 0, 0),
        disc: Math.max(LEAST_DISC * (stem - stern),
            t.diameter > 0 ? t.diameter : disc(largestThrust(t))),
    }));
}

/** Propellers of `propulsion`: their thrust is no force of a frame, so they face ahead.  length: of the waterline; null
 *  for a hull of a file, which has its own. */
function propellersOf({ propulsion: p, hull: form }, hull, disc) {
    if (typeof p?.bollard_pull !== 'number') return [];
    const [stern, stem] = reachOf(hull), or = (given, other) => (typeof given === 'number' ? given : other);
    const count = p.propellers, length = form.form === 'file' ? null : form.length;
    const diameter = or(p.propeller_diameter, disc(p.bollard_pull / count));
    const apart = or(p.propeller_spacing, SPACING * diameter);
    return Array.from({ length: count }, (_, k) => ({
        own: true, hull, rest: new THREE.Vector3(1, 0, 0), disc: Math.max(LEAST_DISC * (stem - stern), diameter),
        x: or(p.steering_x, null), y: (k - (count - 1) / 2) * apart, z: or(p.propeller_z, null), length,
    }));
}

// ---- from the frame ----

/** Where a propeller stands in the hull's axes, from its centre of mass as src/sim/wash.c has it: the waterline is that
 *  of the first frame shown. */
function astern({ hull, x, y, z, length }, poses) {
    const height = poses.pose[7 * hull.index + 2];
    const keel = height + hull.vertices.reduce((least, v, i) => (i % 3 === 2 ? Math.min(least, v) : least), Infinity);
    return new THREE.Vector3(x ?? -STERN * (length ?? lengthAt(hull, -height)), y, (z ?? DEPTH * keel) - height);
}

/** From end to end of where a hull's surface crosses a height of its axes [m]. */
function lengthAt({ vertices, triangles }, height) {
    let [stern, stem] = [Infinity, -Infinity];
    triangles.forEach((a, i) => {
        const b = triangles[i % 3 === 2 ? i - 2 : i + 1];
        const [from, to] = [vertices[3 * a + 2] - height, vertices[3 * b + 2] - height];
        if (from > 0 === to > 0) return;
        const x = vertices[3 * a] + (vertices[3 * b] - vertices[3 * a]) * from / (from - to);
        stern = Math.min(stern, x);
        stem = Math.max(stem, x);
    });
    return stem - stern;
}

/** Forces of a kind by what they belong to: numbers count within a vessel, so where several have one of it, it belongs
 *  to the one that it fits best. */
function matched(list, poses, kind) {
    const found = new Map();
    for (const f of poses.forces) {
        if (f.kind !== kind) continue;
        const pull = { point: new THREE.Vector3(...f.point), force: new THREE.Vector3(...f.force) };
        let best = null, least = Infinity;
        for (const one of list) {
            if (one.number !== f.which || found.has(one)) continue;
            const far = one.anchor ? missed(one, pull) : astray(one, local(pull.point, one.hull, poses));
            if (far < least) { best = one; least = far; }
        }
        if (best) found.set(best, pull);
    }
    return found;
}

/** From amidships and from the centre of mass: the same to some metres. */
function astray({ given }, place) { return Math.hypot(place.x - given[0], place.y - given[1]); }

/** How far off its anchor a line would end that leads where the force does. */
function missed(line, { point, force }) {
    const way = line.distance / (Math.hypot(force.x, force.y) || 1);
    return Math.hypot(point.x + way * force.x - line.anchor.x, point.y + way * force.y - line.anchor.y);
}

const poseOf = (pose, at = 0) => [new THREE.Vector3().fromArray(pose, at),
    new THREE.Quaternion().fromArray(pose, at + 3)];

/** A point at the frame of the forces, in the frame of a hull. */
function local(point, hull, poses) {
    const [place, turn] = poseOf(poses.poseAtForces(hull.index));
    return point.clone().sub(place).applyQuaternion(turn.invert());
}

function global(point, hull, poses) {
    const [place, turn] = poseOf(poses.pose, 7 * hull.index);
    return point.clone().applyQuaternion(turn).add(place);
}

function turned(way, hull, poses) { return way.clone().applyQuaternion(poseOf(poses.pose, 7 * hull.index)[1]); }

/** From the frame of the forces to the moment that is shown. */
function carried(point, hull, poses) { return global(local(point, hull, poses), hull, poses); }

// ---- shapes ----

/** An elastic catenary from its upper end, which it pulls on with `horizontal` and `vertical` [N], to an anchor `way`
 *  off and `height` below on a flat bottom (Jonkman 2007, as src/vessel/catenary.c): [distance, depth] from the upper
 *  end, FREE + 2 times [m]. */
function hanging(horizontal, vertical, { weight, stiffness }, way, height) {
    if (!(vertical > 0)) return [[0, 0], [way, height]];
    const h = Math.max(horizontal, 1e-6 * vertical), free = vertical / weight;
    const at = (u) => { // after u metres of unstretched line
        const v = vertical - weight * u;
        return [h / weight * (Math.asinh(vertical / h) - Math.asinh(v / h)) + h * u / stiffness,
            (Math.hypot(h, vertical) - Math.hypot(h, v)) / weight + (vertical + v) * u / (2 * stiffness)];
    };
    // One that hangs free to its anchor gets so deep before it is level.
    let high = free;
    if (at(free)[1] > height)
        for (let low = 0, k = 0; k < 40; k++) {
            const mid = (low + high) / 2;
            if (at(mid)[1] < height) low = mid; else high = mid;
        }
    // Pose and forces of moments apart do not fit exactly: the anchor does not move for that.
    const [far, deep] = at(high), along = far > way || high < 0.999 * free ? way / far : 1, down = height / deep;
    return [...Array.from({ length: FREE + 1 }, (_, k) => {
        const [x, z] = at(high * k / FREE);
        return [x * along, z * down];
    }), [way, height]];
}

/** A line of at most SEGMENTS pieces; those that it has not have no length. */
function strokes(points) {
    const last = points.length - 1;
    return Array.from({ length: SEGMENTS }, (_, k) => [points[Math.min(k, last)], points[Math.min(k + 1, last)]]);
}

/** A straight line that is told from others without its colour. */
function dashes(from, to) {
    const at = (k) => from.clone().lerp(to, k / (2 * SEGMENTS - 1));
    return Array.from({ length: SEGMENTS }, (_, k) => [at(2 * k), at(2 * k + 1)]);
}

/** What of a line lies between two corners, seen from above: up to where it leaves. */
export function cut(points, low, high) {
    const out = [points[0]];
    for (let k = 1; k < points.length; k++) {
        const a = points[k - 1], b = points[k];
        let part = 1;
        for (const axis of ['x', 'y']) {
            if (b[axis] > high[axis]) part = Math.min(part, (high[axis] - a[axis]) / (b[axis] - a[axis]));
            if (b[axis] < low[axis]) part = Math.min(part, (low[axis] - a[axis]) / (b[axis] - a[axis]));
        }
        out.push(a.clone().lerp(b, Math.max(0, part)));
        if (part < 1) break;
    }
    return out;
}
