// The three.js scene, its lights and its renderer. It is drawn when something has changed.
import { Color, DirectionalLight, HemisphereLight, PerspectiveCamera, Scene, WebGLRenderer } from "three";
import { THEMES } from "./colours.js";

/** Whether this computer draws without a graphics card. */
function isSoftware() {
    const context = document.createElement("canvas").getContext("webgl");
    const named = context?.getExtension("WEBGL_debug_renderer_info");
    const name = named ? context.getParameter(named.UNMASKED_RENDERER_WEBGL) : "";
    context?.getExtension("WEBGL_lose_context")?.loseContext();
    return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

export class Stage {
    /** `crowded`: so much is drawn that smooth edges cost too much without a graphics card;
     *  `renderer`: one that draws to the canvas already. */
    constructor(canvas, theme, crowded, renderer = null) {
        this.canvas = canvas;
        const antialias = !(crowded && !renderer && isSoftware());
        this.renderer = renderer ?? new WebGLRenderer({ canvas, antialias, powerPreference: "high-performance" });
        this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
        this.scene = new Scene();
        // Matrices are written where bodies are placed, not searched for in every frame.
        this.scene.matrixWorldAutoUpdate = false;
        this.camera = new PerspectiveCamera(32, 1, 0.1, 1000);
        this.hemisphere = new HemisphereLight(0xffffff, 0xffffff, 1.7);
        this.lamp = new DirectionalLight(0xffffff, 2.1);
        this.scene.add(this.hemisphere, this.lamp, this.lamp.target);
        this.strokes = new Set();
        this.width = 1;
        this.height = 1;
        this.setTheme(theme);
    }

    setTheme(theme) {
        this.theme = theme;
        this.palette = THEMES[theme];
        this.scene.background = new Color(this.palette.background);
        this.hemisphere.color.set(this.palette.sky);
        this.hemisphere.groundColor.set(this.palette.soil);
    }

    /** The sky is where `upward` points to. */
    setUpward(upward) {
        this.hemisphere.matrixWorld.setPosition(upward);
    }

    add(...objects) {
        for (const object of objects) {
            object.matrixWorldAutoUpdate = false;
            object.frustumCulled = false;
            this.scene.add(object);
        }
    }

    /** Lines whose width is in pixels need to know the size of the picture. */
    addStrokes(strokes) {
        this.strokes.add(strokes);
        this.add(strokes.mesh);
        strokes.setResolution(this.width, this.height);
        return strokes;
    }

    removeStrokes(strokes) {
        this.strokes.delete(strokes);
        this.scene.remove(strokes.mesh);
        strokes.dispose();
    }

    /** Gives back what the graphics card holds of the scene. */
    free() {
        for (const strokes of this.strokes) strokes.dispose();
        this.scene.traverse(({ geometry, material }) => {
            geometry?.dispose();
            material?.dispose?.();
        });
        this.scene.clear();
    }

    resize(width, height) {
        this.width = Math.max(width, 1);
        this.height = Math.max(height, 1);
        this.renderer.setSize(this.width, this.height, false);
        this.camera.aspect = this.width / this.height;
        this.camera.updateProjectionMatrix();
        for (const strokes of this.strokes) strokes.setResolution(this.width, this.height);
    }

    /** Light comes over the left shoulder of who looks. */
    render() {
        const { camera, lamp } = this;
        camera.updateMatrixWorld();
        const e = camera.matrixWorld.elements;
        lamp.matrixWorld.setPosition(
            e[8] - 0.45 * e[0] + 0.7 * e[4],
            e[9] - 0.45 * e[1] + 0.7 * e[5],
            e[10] - 0.45 * e[2] + 0.7 * e[6],
        );
        this.renderer.render(this.scene, camera);
    }
}
