// Which body lies under a place on the picture.
import { Raycaster, Vector2, Vector3 } from "three";

const REACH = 14; // pixels around a body's origin that count as the body

export class Picker {
    constructor(stage, bodies, meshes) {
        this.stage = stage;
        this.bodies = bodies;
        this.meshes = meshes;
        this.ray = new Raycaster();
    }

    /** Index of the body at (x, y) pixels of the picture, -1 when there is none. */
    at(x, y) {
        const { width, height, camera } = this.stage;
        this.ray.setFromCamera(new Vector2((2 * x) / width - 1, 1 - (2 * y) / height), camera);
        for (const mesh of this.meshes) {
            if (mesh.isInstancedMesh) mesh.boundingSphere = null; // its instances have moved
        }
        const hits = this.ray.intersectObjects(this.meshes.filter(({ visible }) => visible), false);
        const bodies = hits.map(({ object, instanceId }) => object.userData.bodyOf(instanceId));
        const moving = bodies.find((b) => this.bodies.list[b].kind !== "ground");
        return moving ?? this.#nearest(x, y) ?? bodies[0] ?? -1;
    }

    #nearest(x, y) {
        const { width, height, camera } = this.stage;
        const place = new Vector3();
        let best = REACH;
        let found;
        for (let b = 0; b < this.bodies.count; b += 1) {
            if (this.bodies.list[b].kind === "ground") continue;
            place.fromArray(this.bodies.point([b, 0, 0, 0], [])).project(camera);
            const distance = Math.hypot(((place.x + 1) / 2) * width - x, ((1 - place.y) / 2) * height - y);
            if (place.z < 1 && distance < best) {
                best = distance;
                found = b;
            }
        }
        return found;
    }
}
