//! Cloths and volumes.

mod bodies;
mod contacts;
mod rods;
mod statics;

use soft::fem::{Contact, Deformable, Material, Parts, solve};
use soft::{Hold, Target, V3};

use super::step;

/// Points and triangles of a flat rectangle along x and y, with alternating diagonals.
fn sheet(size: [f64; 2], cells: [usize; 2]) -> (Vec<V3>, Vec<[usize; 3]>) {
    let [nx, ny] = cells;
    let at = |i: usize, j: usize| {
        V3::new(
            size[0] * i as f64 / nx as f64,
            size[1] * j as f64 / ny as f64,
            0.0,
        )
    };
    let points = (0..=ny)
        .flat_map(|j| (0..=nx).map(move |i| at(i, j)))
        .collect();
    let cells = (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j)));
    let triangles = cells.flat_map(|(i, j)| {
        let [a, b] = [j * (nx + 1) + i, j * (nx + 1) + i + 1];
        let [c, d] = [a + nx + 1, b + nx + 1];
        if (i + j) % 2 == 0 {
            [[a, b, d], [a, d, c]]
        } else {
            [[a, b, c], [b, d, c]]
        }
    });
    (points, triangles.collect())
}

/// Points and tetrahedra of a box from the origin, six in each cell.
fn block(size: V3, [nx, ny, nz]: [usize; 3]) -> (Vec<V3>, Vec<[usize; 4]>) {
    let number = |i: usize, j: usize, k: usize| (k * (ny + 1) + j) * (nx + 1) + i;
    let mut points = Vec::new();
    for k in 0..=nz {
        for j in 0..=ny {
            for i in 0..=nx {
                let part = V3::new(
                    i as f64 / nx as f64,
                    j as f64 / ny as f64,
                    k as f64 / nz as f64,
                );
                points.push(size.component_mul(&part));
            }
        }
    }
    let mut tetrahedra = Vec::new();
    for (i, j, k) in (0..nx * ny * nz).map(|n| (n % nx, n / nx % ny, n / nx / ny)) {
        let corner = |bits: usize| number(i + (bits & 1), j + (bits >> 1 & 1), k + (bits >> 2));
        for [a, b] in [[1, 3], [3, 2], [2, 6], [6, 4], [4, 5], [5, 1]] {
            tetrahedra.push([0, a, b, 7].map(corner));
        }
    }
    (points, tetrahedra)
}

/// The faces of one element only.
fn surface_of(tetrahedra: &[[usize; 4]]) -> Vec<[usize; 3]> {
    let mut faces = std::collections::BTreeMap::new();
    for [a, b, c, d] in tetrahedra {
        for face in [[*a, *c, *b], [*a, *b, *d], [*a, *d, *c], [*b, *c, *d]] {
            let mut name = face;
            name.sort_unstable();
            faces.entry(name).or_insert((face, 0)).1 += 1;
        }
    }
    let own = faces.into_values().filter(|(_, count)| *count == 1);
    own.map(|(face, _)| face).collect()
}

/// A sphere around the origin.
pub(crate) fn sphere(radius: f64, divisions: usize) -> (Vec<V3>, Vec<[usize; 3]>) {
    let mut points = vec![V3::x(), V3::y(), V3::z(), -V3::x(), -V3::y(), -V3::z()];
    let mut triangles = vec![
        [0, 1, 2],
        [1, 3, 2],
        [3, 4, 2],
        [4, 0, 2],
        [1, 0, 5],
        [3, 1, 5],
        [4, 3, 5],
        [0, 4, 5],
    ];
    for _ in 0..divisions {
        let mut middles = std::collections::BTreeMap::new();
        let mut finer = Vec::new();
        for [a, b, c] in triangles {
            let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(from, to): (usize, usize)| {
                *middles
                    .entry((from.min(to), from.max(to)))
                    .or_insert_with(|| {
                        points.push((points[from] + points[to]).normalize());
                        points.len() - 1
                    })
            });
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    (
        points.iter().map(|point| point * radius).collect(),
        triangles,
    )
}

fn hold_at_rest(part: &mut Deformable, is_held: impl Fn(&V3) -> bool) {
    let places = part.points().to_vec();
    for (node, place) in places
        .iter()
        .enumerate()
        .filter(|(_, place)| is_held(place))
    {
        part.holds
            .push(Hold::new(node, Target::Place(*place), None));
    }
}

fn run(part: Deformable, steps: usize) -> Deformable {
    run_under(step(0.005), part, steps)
}

fn run_under(step: soft::Step, part: Deformable, steps: usize) -> Deformable {
    let mut parts = [part];
    for _ in 0..steps {
        assert!(solve(
            Parts::without_rods(&mut parts, &mut []),
            &mut [],
            step
        ));
    }
    let [part] = parts;
    part
}

/// A volume of tetrahedra.
fn solid(
    (points, tetrahedra): (Vec<V3>, Vec<[usize; 4]>),
    density: f64,
    material: Material,
) -> Deformable {
    let surface = surface_of(&tetrahedra);
    Deformable::volume(&points, &tetrahedra, &surface, density, material).expect("it is a mesh")
}

/// A sheet of 0.1 by 0.2 m and 1 kg/m2 that hangs from its upper edge, and the number of its triangles.
fn hanging_sheet(material: Material) -> (Deformable, usize) {
    let (points, triangles) = sheet([0.1, 0.2], [4, 8]);
    let upright: Vec<V3> = points.iter().map(|p| V3::new(p.x, 0.0, p.y)).collect();
    let mut cloth =
        Deformable::cloth(&upright, &triangles, true, 1.0, material).expect("it is a mesh");
    hold_at_rest(&mut cloth, |place| place.z > 0.2 - 1e-9);
    (cloth, triangles.len())
}

/// A step with contacts that go on from step to step.
fn run_in_contact(parts: &mut [Deformable], kept: &mut Vec<Contact>, mut contacts: Vec<Contact>) {
    Contact::carry_on(&mut contacts, kept);
    assert!(solve(
        Parts::without_rods(parts, &mut contacts),
        &mut [],
        step(0.005)
    ));
    *kept = contacts;
}
