//! Regular meshes of rectangles and boxes.

/// Points and triangles of a rectangle around the origin in the plane of x and y, facing up; diagonals alternate.
pub(super) fn sheet(size: [f64; 2], [nx, ny]: [usize; 2]) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let at = |size: f64, i: usize, n: usize| size * (i as f64 / n as f64 - 0.5);
    let point = |i: usize, j: usize| [at(size[0], i, nx), at(size[1], j, ny), 0.0];
    let points = (0..=ny).flat_map(|j| (0..=nx).map(move |i| point(i, j)));
    let number = |i: usize, j: usize| (j * (nx + 1) + i) as u32;
    let cells = (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j)));
    let triangles = cells.flat_map(|(i, j)| {
        let [a, b, c, d] =
            [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)].map(|(i, j)| number(i, j));
        if (i + j) % 2 == 0 {
            [[a, b, d], [a, d, c]]
        } else {
            [[a, b, c], [b, d, c]]
        }
    });
    (points.collect(), triangles.collect())
}

/// Points and tetrahedra of a box around the origin.
pub(super) fn block(size: [f64; 3], count: [usize; 3]) -> (Vec<[f64; 3]>, Vec<[u32; 4]>) {
    mesh_processing::grid(
        size.map(|x| -0.5 * x),
        [0, 1, 2].map(|axis| size[axis] / count[axis] as f64),
        count,
    )
}
