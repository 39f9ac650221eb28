// Many copies of one geometry, each fixed to a body.
import {
    Color, DynamicDrawUsage, EdgesGeometry, InstancedBufferGeometry, InstancedMesh, LineSegments, Matrix4,
    MeshLambertMaterial, Quaternion, ShaderMaterial,
} from "three";
import { multiplyMatrices } from "./bodies.js";

const EDGE_VERTEX = `
attribute mat4 instanceMatrix;
void main() {
    gl_Position = projectionMatrix * modelViewMatrix * instanceMatrix * vec4(position, 1.0);
}`;
const EDGE_FRAGMENT = `
uniform vec3 ink;
uniform float opacity;
void main() {
    gl_FragColor = vec4(ink, opacity);
    #include <colorspace_fragment>
}`;

const EDGE_ANGLE = 35; // degrees between faces from which on their edge is drawn

/** Edges of a geometry at the same places as the instances of it. */
function edgesOf(geometry, mesh) {
    const edges = new EdgesGeometry(geometry, EDGE_ANGLE);
    const instanced = new InstancedBufferGeometry();
    instanced.setAttribute("position", edges.getAttribute("position"));
    instanced.setAttribute("instanceMatrix", mesh.instanceMatrix);
    instanced.instanceCount = mesh.count;
    const lines = new LineSegments(
        instanced,
        new ShaderMaterial({
            vertexShader: EDGE_VERTEX,
            fragmentShader: EDGE_FRAGMENT,
            transparent: true,
            uniforms: { ink: { value: new Color("#10161d") }, opacity: { value: 0.55 } },
        }),
    );
    lines.frustumCulled = false;
    lines.matrixAutoUpdate = false;
    return lines;
}

export class Instances {
    /** `items`: {body, local (Matrix4 in the body), colour}. */
    constructor(geometry, items, bodies, { opacity = 1, side, edges = false, behind = false } = {}) {
        this.bodies = bodies;
        this.items = items;
        this.locals = new Float32Array(16 * items.length);
        const material = new MeshLambertMaterial({
            vertexColors: geometry.hasAttribute("color"),
            transparent: opacity < 1,
            opacity,
            depthWrite: opacity === 1,
            // Edges are seen on faces, and a ghost is not seen where it coincides with its body.
            polygonOffset: edges || behind,
            polygonOffsetFactor: behind ? 4 : 1,
            polygonOffsetUnits: behind ? 16 : 1,
            ...(side === undefined ? {} : { side }),
        });
        this.mesh = new InstancedMesh(geometry, material, items.length);
        this.mesh.instanceMatrix.setUsage(DynamicDrawUsage);
        this.mesh.frustumCulled = false;
        this.mesh.matrixAutoUpdate = false;
        this.mesh.userData.bodyOf = (k) => items[k].body;
        items.forEach((item, k) => {
            item.local.toArray(this.locals, 16 * k);
            this.mesh.setColorAt(k, new Color(item.colour));
            this.#write(k);
        });
        this.moving = Uint32Array.from(items.keys()).filter((k) => bodies.moving[items[k].body]);
        this.edges = edges ? edgesOf(geometry, this.mesh) : null;
    }

    get objects() {
        return this.edges ? [this.mesh, this.edges] : [this.mesh];
    }

    #write(k) {
        const { bodies, items, locals, mesh } = this;
        multiplyMatrices(bodies.matrices, 16 * items[k].body, locals, 16 * k, mesh.instanceMatrix.array, 16 * k);
    }

    update() {
        if (!this.moving.length) return;
        for (const k of this.moving) this.#write(k);
        this.mesh.instanceMatrix.needsUpdate = true;
    }

    setTheme({ edge, edgeOpacity }) {
        const uniforms = this.edges?.material.uniforms;
        uniforms?.ink.value.set(edge);
        if (uniforms) uniforms.opacity.value = edgeOpacity;
    }

    /** Colours the instances of the body `b` (or of all bodies when it is null). */
    paint(b, colourOf) {
        this.items.forEach((item, k) => {
            if (b === null || item.body === b) this.mesh.setColorAt(k, new Color(colourOf(item)));
        });
        this.mesh.instanceColor.needsUpdate = true;
    }
}

/** Matrix of a frame [x, y, z, qx, qy, qz, qw], then shifted and scaled in it. */
export function placed(frame, shift, scale, out = new Matrix4()) {
    const [x, y, z, qx, qy, qz, qw] = frame;
    out.makeRotationFromQuaternion(new Quaternion(qx, qy, qz, qw)).setPosition(x, y, z);
    out.multiply(new Matrix4().makeTranslation(...shift));
    return out.multiply(new Matrix4().makeScale(...scale));
}
