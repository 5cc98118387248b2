// The 3-D scene: one mesh for all prisms, whose poses the vertex shader fetches from a texture, one for the solids,
// water.
// Frame: X, Y horizontal, Z up, metres, as in Fram.
import * as THREE from 'three';
import { Haloes } from './halo.js';
import { FORCE_COLOURS, MARK, MARK_EDGE } from './legend.js';
import { Arrows, HullPressure, LitFloes } from './overlay.js';
import { hullsOf } from './record.js';
import { scenarioOf, sizesOf } from './scenario.js';
import { Station } from './station.js';
import { mergeGeometries } from 'three/examples/jsm/utils/BufferGeometryUtils.js';

const WATER = 0x2f6690, SKY = 0xdfe8ef, HULL = 0xb5402a, WALL = 0x7a726c, ICE = 0xf1f6fa;
const ARROWS = 2048; // at most
const TEXELS = 3; // a body in the texture: (position, shown), quaternion, colour

/** What draws on a canvas; null in a browser that cannot. */
export function rendererOn(canvas) {
    try {
        return new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    } catch {
        return null;
    }
}

export class Scene {
    constructor(renderer, record, poses, first) {
        this.record = record;
        this.poses = poses;
        const told = scenarioOf(record);
        this.metre = sizesOf(told).length; // of full size
        this.domain = told.domain ?? {};
        this.renderer = renderer;
        this.scene = new THREE.Scene();
        this.scene.background = new THREE.Color(SKY);
        this.camera = new THREE.PerspectiveCamera(40, 1, this.metre, 20000 * this.metre);
        this.camera.up.set(0, 0, 1);
        this.haloes = new Haloes(this.scene);
        this.addBodies();
        this.findBoxes(first);
        this.addWaterAndLight();
        this.addArrows();
        this.addMarkers();
        this.addRing();
        this.station = new Station(this.scene, record, this.water, this.haloes);
        this.lit = new LitFloes(this.scene);
        this.peakArrows = new Arrows(this.scene, this.haloes);
        const hulls = hullsOf(record), { pressure } = record;
        if (hulls[pressure?.vessel]) this.pressure = new HullPressure(this.scene, pressure, hulls[pressure.vessel]);
    }

    addWaterAndLight() {
        const size = this.box.getSize(new THREE.Vector3()), centre = this.box.getCenter(new THREE.Vector3());
        const water = this.water = new THREE.Mesh(new THREE.PlaneGeometry(6 * size.x, 6 * size.y),
            new THREE.MeshLambertMaterial({ color: WATER, transparent: true, opacity: 0.86 }));
        water.position.set(centre.x, centre.y, 0);
        water.renderOrder = 1;
        const sun = new THREE.DirectionalLight(0xffffff, 2.2);
        sun.position.set(-0.4, -0.7, 1.3);
        this.scene.add(water, sun, new THREE.HemisphereLight(0xffffff, 0x8090a0, 1.3));
    }

    addBodies() {
        const bodies = this.record.bodies;
        this.width = 1024 * TEXELS;
        const rows = Math.ceil(bodies.length / 1024);
        this.data = new Float32Array(4 * this.width * rows);
        this.texture = new THREE.DataTexture(this.data, this.width, rows, THREE.RGBAFormat, THREE.FloatType);
        const geometry = mergedGeometry(bodies);
        const material = new THREE.MeshLambertMaterial({ side: THREE.FrontSide });
        material.onBeforeCompile = (shader) => this.fetchPoses(shader);
        this.mesh = new THREE.Mesh(geometry, material);
        this.mesh.frustumCulled = false;
        this.scene.add(this.mesh);
        const lines = new THREE.LineBasicMaterial({ color: 0x5b7388 });
        lines.onBeforeCompile = (shader) => this.fetchPoses(shader);
        this.edges = new THREE.LineSegments(edgeGeometry(bodies, 0.01 * this.metre), lines);
        this.edges.frustumCulled = false;
        this.scene.add(this.edges);
    }

    /** Water and bodies like glass, to see what of the hull meets ice. */
    veil(on) {
        const { material } = this.mesh;
        this.water.material.opacity = on ? 0.3 : 0.86;
        Object.assign(material, { transparent: on, depthWrite: !on, opacity: on ? 0.25 : 1, needsUpdate: true });
    }

    /** Bodies, fractures or both are more than they were. */
    grow() {
        for (const old of [this.mesh, this.edges, ...this.marks]) {
            this.scene.remove(old);
            old.geometry.dispose();
            old.material.dispose();
        }
        this.texture.dispose();
        this.addBodies();
        this.addMarkers();
    }

    /** Vertices are given in the body's frame: turn and move them by the pose of their body. */
    fetchPoses(shader) {
        shader.uniforms.poses = { value: this.texture };
        const fetch = (k) =>
            `texelFetch(poses, ivec2(int(mod(body, 1024.0)) * ${TEXELS} + ${k}, int(body / 1024.0)), 0)`;
        shader.vertexShader = shader.vertexShader
            .replace('#include <common>', `#include <common>
                uniform sampler2D poses;
                attribute float body;
                attribute vec2 ship;
                varying vec3 bodyColour;
                varying vec3 onShip;
                vec3 turned(vec3 v, vec4 q) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }`)
            .replace('#include <beginnormal_vertex>', `#include <beginnormal_vertex>
                objectNormal = turned(objectNormal, ${fetch(1)});`)
            .replace('#include <begin_vertex>', `vec4 place = ${fetch(0)};
                vec3 transformed = place.w > 0.5 ? turned(position, ${fetch(1)}) + place.xyz : vec3(0.0, 0.0, -1.0e6);
                onShip = vec3(ship, transformed.z);
                bodyColour = ${fetch(2)}.rgb;`);
        shader.fragmentShader = shader.fragmentShader
            .replace('#include <common>', `#include <common>
                varying vec3 bodyColour;
                varying vec3 onShip;`);
        if (shader.fragmentShader.includes('lambert') || shader.fragmentShader.includes('reflectedLight'))
            shader.fragmentShader = shader.fragmentShader
                .replace('#include <color_fragment>', `vec3 paint = bodyColour;
                    if (onShip.x > 1.5) paint = onShip.y > 0.94 ? ${glsl(BOW)} : ${glsl(DECK)};
                    else if (onShip.x > 0.5 && abs(onShip.z) < ${float(0.3 * this.metre)}) paint = ${glsl(LINE)};
                    diffuseColor.rgb *= paint;`);
    }

    /** Poses and colours to the texture. rgb: three numbers a body. */
    update(rgb) {
        const { pose, shown } = this.poses, d = this.data, n = this.record.bodies.length;
        for (let k = 0, at = 0, p = 0, c = 0; k < n; k++, at += 4 * TEXELS, p += 7, c += 3) {
            d[at] = pose[p]; d[at + 1] = pose[p + 1]; d[at + 2] = pose[p + 2]; d[at + 3] = shown[k];
            d[at + 4] = pose[p + 3]; d[at + 5] = pose[p + 4]; d[at + 6] = pose[p + 5]; d[at + 7] = pose[p + 6];
            d[at + 8] = rgb[c]; d[at + 9] = rgb[c + 1]; d[at + 10] = rgb[c + 2];
        }
        this.texture.needsUpdate = true;
    }

    /** Forces on the vessel: one arrow each, in one drawing. */
    addArrows() {
        const shaft = new THREE.CylinderGeometry(0.045, 0.045, 0.7, 8).translate(0, 0.35, 0);
        const head = new THREE.ConeGeometry(0.13, 0.3, 12).translate(0, 0.85, 0);
        const material = new THREE.MeshBasicMaterial({ depthTest: false, transparent: true });
        this.arrows = new THREE.InstancedMesh(mergeGeometries([shaft, head]), material, ARROWS);
        this.arrows.frustumCulled = false;
        this.arrows.renderOrder = 3;
        this.arrows.count = 0;
        this.scene.add(this.arrows);
        this.haloes.add(this.arrows);
    }

    /** Ice pushes: its arrows end where it acts; lines and thrusters pull: theirs begin there.  scale: [m/N] */
    showForces(forces, scale) {
        const at = new THREE.Vector3(), way = new THREE.Vector3(), turn = new THREE.Quaternion();
        const size = new THREE.Vector3(), up = new THREE.Vector3(0, 1, 0), matrix = new THREE.Matrix4();
        let n = 0;
        for (const f of forces) {
            if (n === ARROWS) break;
            way.set(...f.force);
            const length = way.length() * scale;
            if (!(length > 0.2 * this.metre)) continue;
            way.normalize();
            turn.setFromUnitVectors(up, way);
            at.set(...f.point);
            if (f.kind === 'ice' || f.kind === 'hull') at.addScaledVector(way, -length);
            const thick = Math.min(length, this.arrowWidth);
            matrix.compose(at, turn, size.set(thick, length, thick));
            this.arrows.setMatrixAt(n, matrix);
            this.arrows.setColorAt(n++, FORCE[f.kind]);
        }
        this.arrows.count = n;
        this.arrows.instanceMatrix.needsUpdate = true;
        if (this.arrows.instanceColor) this.arrows.instanceColor.needsUpdate = true;
    }

    /** Where floes broke: points that are shown once their time has come. */
    addMarkers() {
        const { fractures } = this.record, geometry = new THREE.BufferGeometry();
        const place = fractures.flatMap((f) => [f.place[0], f.place[1], f.place[2] + this.metre]);
        geometry.setAttribute('position', new THREE.Float32BufferAttribute(place, 3));
        geometry.setDrawRange(0, 0);
        this.marks = [[MARK_EDGE, 10], [MARK, 7]].map(([color, size], k) => {
            const material = new THREE.PointsMaterial({ color, size, sizeAttenuation: false });
            const points = new THREE.Points(geometry, material);
            points.frustumCulled = false;
            points.renderOrder = 2 + 0.1 * k;
            this.scene.add(points);
            return points;
        });
        this.markers = this.marks[1];
    }

    /** Those of the `span` seconds before `time`; fractures are in the order of time. */
    showMarkers(time, span) {
        const { fractures } = this.record, after = (t) => {
            let lo = 0, hi = fractures.length;
            while (lo < hi) { const mid = (lo + hi) >> 1; if (fractures[mid].time <= t) lo = mid + 1; else hi = mid; }
            return lo;
        };
        const from = after(time - span);
        this.markers.geometry.setDrawRange(from, after(time) - from);
    }

    /** The outline of the picked floe. */
    addRing() {
        const material = new THREE.LineBasicMaterial({ color: 0xffc400, depthTest: false, transparent: true });
        this.ring = new THREE.LineLoop(new THREE.BufferGeometry(), material);
        this.ring.frustumCulled = false;
        this.ring.visible = false;
        this.ring.renderOrder = 4;
        this.scene.add(this.ring);
    }

    pick(body) {
        this.ring.visible = body !== null;
        if (!body) return;
        const points = body.outline.flatMap(([x, y]) => [x, y, body.thickness / 2 + 0.05 * this.metre]);
        this.ring.geometry.dispose();
        this.ring.geometry = new THREE.BufferGeometry();
        this.ring.geometry.setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
    }

    placeRing(body) {
        const p = this.poses.pose.subarray(7 * body.index, 7 * body.index + 7);
        this.ring.position.set(p[0], p[1], p[2]);
        this.ring.quaternion.set(p[3], p[4], p[5], p[6]);
        this.ring.visible = this.poses.shown[body.index] === 1;
    }

    /** The floe under a point of the canvas (-1 to 1 both ways), by its outline seen from above; null: none. */
    bodyAt(x, y) {
        const ray = new THREE.Raycaster(), hit = new THREE.Vector3();
        ray.setFromCamera(new THREE.Vector2(x, y), this.camera);
        const surface = new THREE.Plane(new THREE.Vector3(0, 0, 1), 0);
        if (!ray.ray.intersectPlane(surface, hit)) return null;
        for (const b of this.record.bodies) {
            if (b.material !== 'ice' || !this.poses.shown[b.index]) continue;
            const p = 7 * b.index, q = this.poses.pose, dx = hit.x - q[p], dy = hit.y - q[p + 1];
            if (dx * dx + dy * dy > b.radius * b.radius) continue;
            const turn = new THREE.Quaternion(q[p + 3], q[p + 4], q[p + 5], q[p + 6]).invert();
            const local = new THREE.Vector3(dx, dy, 0).applyQuaternion(turn);
            if (inside(b.outline, local.x, local.y)) return b;
        }
        return null;
    }

    /** Floes that are in the view, the nearest to a point first. */
    floesFrom({ x, y }) {
        const { pose, shown } = this.poses, at = new THREE.Vector3(), far = new Map();
        this.camera.updateMatrixWorld();
        for (const b of this.record.bodies) {
            if (b.material !== 'ice' || !shown[b.index]) continue;
            const seen = at.fromArray(pose, 7 * b.index).project(this.camera);
            if (Math.abs(seen.x) > 1 || Math.abs(seen.y) > 1 || Math.abs(seen.z) > 1) continue;
            far.set(b, Math.hypot(pose[7 * b.index] - x, pose[7 * b.index + 1] - y));
        }
        return [...far.keys()].sort((a, b) => far.get(a) - far.get(b));
    }

    render() { this.renderer.render(this.scene, this.camera); }

    /** To pixels of the screen that the window is on now, at the size it is seen at. */
    resize(width, height) {
        this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
        this.renderer.setSize(width, height);
        this.haloes.resize(width, height);
        this.camera.aspect = width / height;
        this.camera.updateProjectionMatrix();
    }

    /** Of the first frame, since a record that grows knows no more: `field` is around its bodies but walls, for what is
     *  seen near a vessel and for arrows, without ice as wide as a vessel, however far apart they are; `box` is around
     *  all that there will be to see, without ice the walls and the domain too, wherever in it vessels will sail and
     *  ice will come. */
    findBoxes(first) {
        const { bodies, origin: [x, y] } = this.record;
        const { x_min: west, x_max: east, y_min: south, y_max: north } = this.domain;
        const there = bodies.filter((b) => b.birth === 0), bare = !there.some((b) => b.material === 'ice');
        const field = new THREE.Box3(), box = new THREE.Box3(), point = new THREE.Vector3();
        for (let i = 0; i < first.poses.length; i += 7)
            field.expandByPoint(point.set(first.poses[i], first.poses[i + 1], 0));
        for (const b of there) {
            if (!b.pose) continue;
            point.set(b.pose[0], b.pose[1], 0);
            if (b.material !== 'wall') field.expandByPoint(point);
            else if (bare) box.expandByPoint(point);
        }
        box.union(field);
        if (bare && east > west && north > south) {
            box.expandByPoint(point.set(west - x, south - y, 0));
            box.expandByPoint(point.set(east - x, north - y, 0));
        }
        if (box.isEmpty()) box.expandByPoint(point.set(0, 0, 0));
        if (field.isEmpty()) field.copy(box);
        const hulls = bare ? there.flatMap((b) => (b.material === 'hull' ? [...b.vertices] : [])) : [];
        if (hulls.length) field.set(field.getCenter(point), point);
        const reach = hulls.reduce((far, v) => Math.max(far, Math.abs(v)), 20 * this.metre);
        this.box = box.expandByScalar(reach);
        this.field = field.expandByScalar(reach);
    }
}

const FORCE = Object.fromEntries(Object.entries(FORCE_COLOURS).map(([kind, c]) => [kind, new THREE.Color(c)]));

function inside(ring, x, y) {
    let odd = false;
    for (let i = 0, j = ring.length - 1; i < ring.length; j = i++) {
        const [a, b] = ring[i], [c, d] = ring[j];
        if (b > y !== d > y && x < (c - a) * (y - b) / (d - b) + a) odd = !odd;
    }
    return odd;
}

const OWN = { ice: new THREE.Color(ICE), hull: new THREE.Color(HULL), wall: new THREE.Color(WALL) };
/** The colour that a body has by itself. */
export function own(body) { return OWN[body.material]; }

/** A hull is painted as a ship is: deck, its bow marked, a white line at the water. */
const DECK = new THREE.Color(0xc9b58c), BOW = new THREE.Color(0x1d3557), LINE = new THREE.Color(0xf4f4f0);
function float(x) { return x.toPrecision(7); }
function glsl(c) { return `vec3(${c.r.toFixed(4)}, ${c.g.toFixed(4)}, ${c.b.toFixed(4)})`; }

/** All prisms and solids with their own normals, tagged by body. */
function mergedGeometry(bodies) {
    const position = [], normal = [], body = [], ship = [];
    // ship: 0 no hull, 1 its side, 2 its deck; and the part of its length from the stern.
    const add = (b, points, n, paint = 0, along = () => 0) => {
        for (const p of points) {
            position.push(p[0], p[1], p[2]);
            normal.push(n[0], n[1], n[2]);
            body.push(b.index);
            ship.push(paint, along(p));
        }
    };
    for (const b of bodies) {
        if (b.outline) addPrism(b, add);
        else addSolid(b, add);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(position, 3));
    geometry.setAttribute('normal', new THREE.Float32BufferAttribute(normal, 3));
    geometry.setAttribute('body', new THREE.Float32BufferAttribute(body, 1));
    geometry.setAttribute('ship', new THREE.Float32BufferAttribute(ship, 2));
    return geometry;
}

function addPrism(b, add) {
    const h = b.thickness / 2, ring = b.outline;
    const flat = THREE.ShapeUtils.triangulateShape(ring.map(([x, y]) => new THREE.Vector2(x, y)), []);
    for (const [i, j, k] of flat) {
        add(b, [i, j, k].map((v) => [...ring[v], h]), [0, 0, 1]);
        add(b, [i, k, j].map((v) => [...ring[v], -h]), [0, 0, -1]);
    }
    ring.forEach((a, i) => {
        const c = ring[(i + 1) % ring.length], dx = c[0] - a[0], dy = c[1] - a[1], l = Math.hypot(dx, dy) || 1;
        const n = [dy / l, -dx / l, 0];
        add(b, [[...a, -h], [...c, -h], [...c, h]], n);
        add(b, [[...a, -h], [...c, h], [...a, h]], n);
    });
}

function addSolid(b, add) {
    const v = (i) => new THREE.Vector3(...b.vertices.subarray(3 * i, 3 * i + 3));
    let [stern, stem, top, keel] = [Infinity, -Infinity, -Infinity, Infinity];
    for (let i = 0; i < b.vertices.length; i += 3) {
        stern = Math.min(stern, b.vertices[i]);
        stem = Math.max(stem, b.vertices[i]);
        keel = Math.min(keel, b.vertices[i + 2]);
        top = Math.max(top, b.vertices[i + 2]);
    }
    const along = (p) => (p[0] - stern) / (stem - stern), hull = b.material === 'hull';
    for (let t = 0; t < b.triangles.length; t += 3) {
        const p = [0, 1, 2].map((k) => v(b.triangles[t + k]));
        const n = p[1].clone().sub(p[0]).cross(p[2].clone().sub(p[0])).normalize();
        const deck = n.z > 0.9 && p.every((q) => q.z > keel + 0.6 * (top - keel));
        add(b, p.map((q) => q.toArray()), n.toArray(), hull ? 1 + deck : 0, along);
    }
}

/** The top rim of every prism, so far over its face, but for the tiles of level ice: their seams are neither boundary
 *  nor crack. */
function edgeGeometry(bodies, over) {
    const position = [], body = [];
    for (const b of bodies) {
        if (!b.outline || b.level) continue;
        b.outline.forEach((a, i) => {
            const c = b.outline[(i + 1) % b.outline.length], z = b.thickness / 2 + over;
            position.push(...a, z, ...c, z);
            body.push(b.index, b.index);
        });
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(position, 3));
    geometry.setAttribute('body', new THREE.Float32BufferAttribute(body, 1));
    return geometry;
}
