// What is drawn over the scene when the page explains something: the floes of a peak lit through what covers them, its
// forces and chains as arrows, and the pressure on a hull by panel.
import * as THREE from 'three';
import { mergeGeometries } from 'three/examples/jsm/utils/BufferGeometryUtils.js';

const SEGMENTS = 256; // at most

/** Outlines of prisms, filled, at their poses. */
export class LitFloes {
    constructor(scene) {
        const over = { depthTest: false, transparent: true, vertexColors: true };
        this.fill = new THREE.Mesh(new THREE.BufferGeometry(),
            new THREE.MeshBasicMaterial({ ...over, opacity: 0.6, side: THREE.DoubleSide }));
        this.rim = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial(over));
        this.parts = [this.fill, this.rim];
        this.parts.forEach((part, k) => {
            part.frustumCulled = false;
            part.renderOrder = 2 + k;
            part.visible = false;
            scene.add(part);
        });
        this.corners = [[], []];
    }

    /** bodies: [[body of the record, {colour}], ...] */
    set(bodies) {
        this.corners = [[], []];
        const colours = [[], []];
        for (const [body, { colour }] of bodies) {
            const ring = body.outline.map(([x, y]) => new THREE.Vector3(x, y, body.thickness / 2));
            const c = new THREE.Color(colour).toArray();
            const put = (k, i) => { this.corners[k].push([body.index, ring[i]]); colours[k].push(...c); };
            for (const face of THREE.ShapeUtils.triangulateShape(ring.map((p) => new THREE.Vector2(p.x, p.y)), []))
                face.forEach((i) => put(0, i));
            ring.forEach((_, i) => { put(1, i); put(1, (i + 1) % ring.length); });
        }
        this.parts.forEach((part, k) => {
            part.geometry.dispose();
            part.geometry = new THREE.BufferGeometry();
            part.geometry.setAttribute('position',
                new THREE.BufferAttribute(new Float32Array(3 * this.corners[k].length), 3));
            part.geometry.setAttribute('color', new THREE.Float32BufferAttribute(colours[k], 3));
        });
    }

    place(poses, visible) {
        const turn = new THREE.Quaternion(), point = new THREE.Vector3();
        this.parts.forEach((part, k) => {
            part.visible = visible && this.corners[k].length > 0;
            if (!part.visible) return;
            const { position } = part.geometry.attributes;
            this.corners[k].forEach(([index, corner], i) => {
                const p = poses.pose.subarray(7 * index, 7 * index + 7);
                point.copy(corner).applyQuaternion(turn.set(p[3], p[4], p[5], p[6]));
                if (poses.shown[index]) position.setXYZ(i, point.x + p[0], point.y + p[1], point.z + p[2]);
                else position.setXYZ(i, 0, 0, -1e6);
            });
            position.needsUpdate = true;
        });
    }
}

/** Arrows from point to point, seen through everything, in one drawing. */
export class Arrows {
    constructor(scene, haloes) {
        const shaft = new THREE.CylinderGeometry(0.5, 0.5, 1, 8).translate(0, 0.5, 0);
        const head = new THREE.ConeGeometry(1.3, 1, 12).translate(0, -0.5, 0);
        const material = () => new THREE.MeshBasicMaterial({ depthTest: false, transparent: true });
        this.shafts = new THREE.InstancedMesh(mergeGeometries([shaft]), material(), SEGMENTS);
        this.heads = new THREE.InstancedMesh(head, material(), SEGMENTS);
        for (const part of [this.shafts, this.heads]) {
            part.frustumCulled = false;
            part.renderOrder = 4;
            part.count = 0;
            scene.add(part);
            haloes.add(part);
        }
    }

    /** segments: [{from, to, colour, width}, ...] [m] */
    show(segments) {
        const up = new THREE.Vector3(0, 1, 0), way = new THREE.Vector3(), at = new THREE.Vector3();
        const turn = new THREE.Quaternion(), size = new THREE.Vector3(), matrix = new THREE.Matrix4();
        const colour = new THREE.Color();
        let n = 0;
        for (const { from, to, colour: name, width } of segments) {
            const length = way.set(to[0] - from[0], to[1] - from[1], to[2] - from[2]).length();
            if (!(length > 0) || n === SEGMENTS) continue;
            const tip = Math.min(0.4 * length, 2.6 * width);
            turn.setFromUnitVectors(up, way.normalize());
            colour.set(name);
            matrix.compose(at.set(...from), turn, size.set(width, length - tip, width));
            this.shafts.setMatrixAt(n, matrix);
            this.shafts.setColorAt(n, colour);
            matrix.compose(at.set(...to), turn, size.set(width, tip, width));
            this.heads.setMatrixAt(n, matrix);
            this.heads.setColorAt(n++, colour);
        }
        for (const part of [this.shafts, this.heads]) {
            part.count = n;
            part.instanceMatrix.needsUpdate = true;
            if (part.instanceColor) part.instanceColor.needsUpdate = true;
        }
    }
}

/** A hull in panels over the hull itself. */
export class HullPressure {
    /** told: {panels, panel: of each triangle, corner: 9 numbers each, mean, largest [Pa]}; hull: its body. */
    constructor(scene, told, hull) {
        this.told = told;
        this.hull = hull;
        const geometry = new THREE.BufferGeometry();
        geometry.setAttribute('position', new THREE.BufferAttribute(told.corner, 3));
        geometry.setAttribute('color', new THREE.BufferAttribute(new Float32Array(told.corner.length), 3));
        this.mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({
            vertexColors: true, polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -2,
        }));
        this.mesh.frustumCulled = false;
        this.mesh.visible = false;
        scene.add(this.mesh);
    }

    /** which: 'mean', 'largest' or 'none'; ramp: three numbers for each of 256 colours.  Returns the end of the ramp,
     *  which one panel in a hundred of those that met ice is above [Pa]. */
    colour(which, ramp) {
        this.mesh.visible = which !== 'none';
        if (!this.mesh.visible) return 0;
        const value = this.told[which], met = value.filter((v) => v > 0).sort();
        const high = met.length ? met[Math.floor(0.99 * (met.length - 1))] : 1;
        const { color } = this.mesh.geometry.attributes;
        this.told.panel.forEach((panel, t) => {
            const c = 3 * Math.min(255, Math.round(255 * value[panel] / high));
            for (let k = 0; k < 3; k++) color.setXYZ(3 * t + k, ramp[c], ramp[c + 1], ramp[c + 2]);
        });
        color.needsUpdate = true;
        return high;
    }

    place(poses) {
        const p = poses.pose.subarray(7 * this.hull.index, 7 * this.hull.index + 7);
        this.mesh.position.set(p[0], p[1], p[2]);
        this.mesh.quaternion.set(p[3], p[4], p[5], p[6]);
    }
}
