// The 3-D scene: one mesh for all prisms, whose poses the vertex shader fetches from a texture, one for the solids,
// water.
// Frame: X, Y horizontal, Z up, metres, as in Fram.
import * as THREE from 'three';

const WATER = 0x2f6690, SKY = 0xdfe8ef, HULL = 0xb5402a, WALL = 0x7a726c, ICE = 0xf1f6fa;
const TEXELS = 3; // a body in the texture: (position, shown), quaternion, colour

export class Scene {
    constructor(canvas, record, poses) {
        this.record = record;
        this.poses = poses;
        this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
        this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
        this.scene = new THREE.Scene();
        this.scene.background = new THREE.Color(SKY);
        this.camera = new THREE.PerspectiveCamera(40, 1, 1, 20000);
        this.camera.up.set(0, 0, 1);
        this.addBodies();
        this.box = this.bounds();
        this.addWaterAndLight();
    }

    addWaterAndLight() {
        const size = this.box.getSize(new THREE.Vector3()), centre = this.box.getCenter(new THREE.Vector3());
        const water = new THREE.Mesh(new THREE.PlaneGeometry(6 * size.x, 6 * size.y),
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
        this.edges = new THREE.LineSegments(edgeGeometry(bodies), lines);
        this.edges.frustumCulled = false;
        this.scene.add(this.edges);
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
                varying vec3 bodyColour;
                vec3 turned(vec3 v, vec4 q) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }`)
            .replace('#include <beginnormal_vertex>', `#include <beginnormal_vertex>
                objectNormal = turned(objectNormal, ${fetch(1)});`)
            .replace('#include <begin_vertex>', `vec4 place = ${fetch(0)};
                vec3 transformed = place.w > 0.5 ? turned(position, ${fetch(1)}) + place.xyz : vec3(0.0, 0.0, -1.0e6);
                bodyColour = ${fetch(2)}.rgb;`);
        shader.fragmentShader = shader.fragmentShader
            .replace('#include <common>', `#include <common>
                varying vec3 bodyColour;`);
        if (shader.fragmentShader.includes('lambert') || shader.fragmentShader.includes('reflectedLight'))
            shader.fragmentShader = shader.fragmentShader
                .replace('#include <color_fragment>', 'diffuseColor.rgb *= bodyColour;');
    }

    /** Poses and colours to the texture. colourOf(body) -> THREE.Color or null for the material's own. */
    update(colourOf) {
        const { pose, shown } = this.poses, d = this.data;
        for (const b of this.record.bodies) {
            const at = 4 * TEXELS * b.index, p = 7 * b.index;
            d[at] = pose[p]; d[at + 1] = pose[p + 1]; d[at + 2] = pose[p + 2]; d[at + 3] = shown[b.index];
            d[at + 4] = pose[p + 3]; d[at + 5] = pose[p + 4]; d[at + 6] = pose[p + 5]; d[at + 7] = pose[p + 6];
            const c = colourOf(b) ?? own(b);
            d[at + 8] = c.r; d[at + 9] = c.g; d[at + 10] = c.b;
        }
        this.texture.needsUpdate = true;
    }

    render() { this.renderer.render(this.scene, this.camera); }

    resize(width, height) {
        this.renderer.setSize(width, height, false);
        this.camera.aspect = width / height;
        this.camera.updateProjectionMatrix();
    }

    /** Box around all bodies of the first frame. */
    bounds() {
        const box = new THREE.Box3(), first = this.record.frames[0];
        for (let i = 0; i < first.order.length; i++)
            box.expandByPoint(new THREE.Vector3(first.poses[7 * i], first.poses[7 * i + 1], 0));
        for (const b of this.record.bodies)
            if (b.pose && b.material !== 'wall') box.expandByPoint(new THREE.Vector3(...b.pose.slice(0, 2), 0));
        if (box.isEmpty()) box.expandByPoint(new THREE.Vector3());
        return box.expandByScalar(20);
    }
}

const OWN = { ice: new THREE.Color(ICE), hull: new THREE.Color(HULL), wall: new THREE.Color(WALL) };
function own(body) { return OWN[body.material]; }

/** All prisms and solids with their own normals, tagged by body. */
function mergedGeometry(bodies) {
    const position = [], normal = [], body = [];
    const add = (b, points, n) => {
        for (const p of points) {
            position.push(...p);
            normal.push(...n);
            body.push(b.index);
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
    for (let t = 0; t < b.triangles.length; t += 3) {
        const p = [0, 1, 2].map((k) => v(b.triangles[t + k]));
        const n = p[1].clone().sub(p[0]).cross(p[2].clone().sub(p[0])).normalize();
        add(b, p.map((q) => q.toArray()), n.toArray());
    }
}

/** The top rim of every prism. */
function edgeGeometry(bodies) {
    const position = [], body = [];
    for (const b of bodies) {
        if (!b.outline) continue;
        b.outline.forEach((a, i) => {
            const c = b.outline[(i + 1) % b.outline.length], z = b.thickness / 2 + 0.01;
            position.push(...a, z, ...c, z);
            body.push(b.index, b.index);
        });
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(position, 3));
    geometry.setAttribute('body', new THREE.Float32BufferAttribute(body, 1));
    return geometry;
}
