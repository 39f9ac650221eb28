// Many rectangles as one piece of geometry: four corners and two triangles each.
import { BufferAttribute } from "three";

/** The same four corners (eight numbers) for each of `count` rectangles. */
export function corners(count, eight) {
    const all = new Float32Array(8 * count);
    for (let k = 0; k < count; k += 1) all.set(eight, 8 * k);
    return all;
}

export function rectangles(count) {
    const index = new Uint32Array(6 * count);
    for (let k = 0; k < count; k += 1) {
        index.set([4 * k, 4 * k + 1, 4 * k + 2, 4 * k, 4 * k + 2, 4 * k + 3], 6 * k);
    }
    return new BufferAttribute(index, 1);
}
