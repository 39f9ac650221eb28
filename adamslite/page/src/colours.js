// Colours that colour-blind people can tell apart, and those of the two themes.

// Okabe and Ito, "Color universal design" (2008); without black, and yellow last.
export const OKABE_ITO = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442"];
export const GROUND = "#8b949e";

export function bodyColour(index) {
    return OKABE_ITO[index % 6];
}

// Which of them stand out on the background of a theme, best first.
const CURVES = { light: [0, 5, 2, 1, 3, 4], dark: [4, 1, 2, 3, 6, 5] };

/** Colour of the n-th curve of a plot. */
export function curveColour(index, theme) {
    const order = CURVES[theme];
    return OKABE_ITO[order[index % order.length]];
}

// Viridis (Smith and van der Walt, 2015) at 17 equal places.
const VIRIDIS = [
    "#440154", "#481769", "#472a7a", "#433d84", "#3d4e8a", "#355e8d", "#2e6d8e", "#297b8e", "#23898e",
    "#1f978b", "#21a585", "#2eb37c", "#46c06f", "#65cb5e", "#89d548", "#b0dd2f", "#fde725",
];

// The part of viridis that is seen on the background of a theme.
const SEEN = { light: [0, 0.88], dark: [0.22, 1] };

const byte = (text, at) => parseInt(text.slice(at, at + 2), 16);

/** Red, green and blue (0..255) of a value 0..1. */
export function viridis(value, theme) {
    const [low, high] = SEEN[theme];
    const place = (low + Math.min(Math.max(value, 0), 1) * (high - low)) * (VIRIDIS.length - 1);
    const k = Math.min(Math.floor(place), VIRIDIS.length - 2);
    return [1, 3, 5].map((at) => {
        const from = byte(VIRIDIS[k], at);
        return Math.round(from + (place - k) * (byte(VIRIDIS[k + 1], at) - from));
    });
}

export function viridisGradient(theme) {
    const stops = Array.from({ length: 13 }, (_, k) => `rgb(${viridis(k / 12, theme).join(" ")})`);
    return `linear-gradient(to right, ${stops.join(", ")})`;
}

export const THEMES = {
    light: {
        background: "#f6f8fa",
        grid: "#c9d1d9",
        gridStrong: "#a3adb8",
        ink: "#1f2328",
        muted: "#59636e",
        line: "#424a53",
        joint: "#424a53",
        spring: "#6e7781",
        force: "#d1242f",
        torque: "#8250df",
        reaction: "#0550ae",
        edge: "#10161d",
        edgeOpacity: 0.55,
        ghost: "#8c959f",
        path: "#bf3989",
        sky: "#ffffff",
        soil: "#b8c0c8",
    },
    dark: {
        background: "#12161c",
        grid: "#262d36",
        gridStrong: "#3a434e",
        ink: "#e6edf3",
        muted: "#9198a1",
        line: "#9aa5b1",
        joint: "#b6c2cf",
        spring: "#aab4c0",
        force: "#ff7b72",
        torque: "#d2a8ff",
        reaction: "#79c0ff",
        edge: "#dfe7f0",
        edgeOpacity: 0.45,
        ghost: "#848d97",
        path: "#ff9bce",
        sky: "#ffffff",
        soil: "#59636e",
    },
};
