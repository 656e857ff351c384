// Colours of what is around the scene, by day and by night.

export const THEMES = {
  light: {
    sky: { zenith: [0.8, 0.855, 0.92], horizon: [0.955, 0.962, 0.97], nadir: [0.86, 0.865, 0.875] },
    grid: { ink: [0.36, 0.4, 0.46], red: [0.8, 0.25, 0.22], green: [0.25, 0.6, 0.28], strength: 0.5 },
    outline: { chosen: [0.05, 0.41, 0.85, 1], hovered: [0.05, 0.41, 0.85, 0.45] },
  },
  dark: {
    sky: { zenith: [0.075, 0.09, 0.12], horizon: [0.2, 0.225, 0.265], nadir: [0.115, 0.125, 0.145] },
    grid: { ink: [0.66, 0.7, 0.76], red: [0.9, 0.36, 0.34], green: [0.38, 0.74, 0.42], strength: 0.32 },
    outline: { chosen: [0.36, 0.66, 1, 1], hovered: [0.36, 0.66, 1, 0.45] },
  },
};
