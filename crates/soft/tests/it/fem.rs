//! Cloths and volumes beside closed forms.

use nalgebra::{Matrix6, Vector6};
use soft::fem::{Contact, Deformable, Material, Surface, nearby, solve};
use soft::{Body, Hold, Target, Touch, V3};

use super::{GRAVITY, near, step, weightless};

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
        assert!(solve(&mut parts, &mut [], &mut [], step));
    }
    let [part] = parts;
    part
}

#[test]
fn a_sheet_is_stretched_by_what_hangs_from_it() {
    let (points, triangles) = sheet([0.1, 0.2], [4, 8]);
    // A force along -y is a body force here: gravity acts along z, so the sheet hangs upright.
    let upright: Vec<V3> = points.iter().map(|p| V3::new(p.x, 0.0, p.y)).collect();
    let material = Material {
        damping: 0.05,
        drag: 2.0,
        ..Material::sheet(1e-3, 1e5, 0.0)
    };
    let mut cloth = Deformable::cloth(&upright, &triangles, true, 1.0, material).unwrap();
    hold_at_rest(&mut cloth, |place| place.z > 0.2 - 1e-9);
    let cloth = run(cloth, 600);
    // Own weight: w g L^2 / 2 by E t.
    let expected = 1.0 * GRAVITY * 0.2 * 0.2 / 2.0 / (1e5 * 1e-3);
    near(-cloth.points()[2].z, expected, 0.02);
    let borne: f64 = cloth.holds.iter().map(|hold| hold.force.z).sum();
    near(borne, 0.02 * GRAVITY, 1e-3);
}

#[test]
fn a_strip_bends_as_a_plate() {
    for cells in [[8, 4], [16, 8]] {
        let (points, triangles) = sheet([0.2, 0.1], cells);
        let material = Material {
            damping: 0.01,
            drag: 3.0,
            ..Material::sheet(2e-3, 5e7, 0.0)
        };
        let mut cloth = Deformable::cloth(&points, &triangles, true, 0.2, material).unwrap();
        let clamped = 0.2 / cells[0] as f64 + 1e-9;
        hold_at_rest(&mut cloth, |place| place.x < clamped);
        let cloth = run(cloth, 1000);
        // Under its own weight, from the middle of the clamped cell on: q L^4 / 8 D.
        let length = 0.2 - 0.2 / cells[0] as f64 * 0.5;
        let expected = 0.2 * GRAVITY * length.powi(4) / (8.0 * material.bend);
        near(-cloth.points()[cells[0]].z, expected, 0.015);
    }
}

#[test]
fn a_beam_of_volume_bends_nearly_as_a_beam() {
    for (layers, part) in [(3, 0.3), (6, 0.1)] {
        let (points, tetrahedra) = block(V3::new(0.2, 0.04, 0.04), [5 * layers, layers, layers]);
        let material = Material {
            damping: 0.02,
            drag: 2.0,
            ..Material::solid(1e6, 0.0)
        };
        let mut beam = Deformable::volume(
            &points,
            &tetrahedra,
            &surface_of(&tetrahedra),
            1000.0,
            material,
        )
        .unwrap();
        hold_at_rest(&mut beam, |place| place.x < 1e-9);
        let beam = run_under(step(0.02), beam, 100);
        let moment = 0.04_f64.powi(4) / 12.0;
        let load = 1000.0 * 0.04 * 0.04 * GRAVITY;
        // Bending and shear.
        let expected = load * 0.2_f64.powi(4) / (8.0 * 1e6 * moment)
            + load * 0.2 * 0.2 / 2.0 / (5.0 / 6.0 * 0.5e6 * 0.04 * 0.04);
        let tip = beam.points()[5 * layers].z;
        near(-tip, expected, part);
    }
}

#[test]
fn a_balloon_bears_its_pressure() {
    // An octahedron, its faces divided and pushed out to a sphere.
    let (points, triangles) = sphere(0.1, 3);
    let material = Material {
        damping: 0.02,
        drag: 5.0,
        ..Material::sheet(1e-3, 1e6, 0.3)
    };
    let mut balloon = Deformable::cloth(&points, &triangles, false, 0.5, material).unwrap();
    hold_at_rest(&mut balloon, |place| place.z > 0.1 - 1e-9);
    let start = balloon.enclosed();
    balloon.fill(20_000.0);
    let balloon = run_under(weightless(0.005), balloon, 400);
    assert!(balloon.enclosed() > start);
    // Tension of a sphere: p r / 2.
    let radius = (balloon.enclosed() * 0.75 / std::f64::consts::PI).cbrt();
    let tensions = balloon.tensions();
    let mean = tensions.iter().sum::<f64>() / tensions.len() as f64;
    near(mean, balloon.pressure() * radius / 2.0, 0.06);
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

/// Contacts of all nodes with a sphere.
fn on_sphere(
    part: &Deformable,
    center: V3,
    radius: f64,
    surface: Surface,
    friction: f64,
) -> Vec<Contact> {
    let contact = |(node, place): (usize, &V3)| {
        let apart = place - center;
        let normal = apart.normalize();
        (apart.norm() < radius + 0.02).then(|| Contact {
            part: 0,
            spot: [(node, 1.0), (node, 0.0), (node, 0.0)],
            surface,
            touch: Touch::new(center + normal * radius, normal, friction),
            key: node as u64,
        })
    };
    part.points()
        .iter()
        .enumerate()
        .filter_map(contact)
        .collect()
}

#[test]
fn a_cloth_lies_on_a_sphere_with_its_weight() {
    let (points, triangles) = sheet([0.4, 0.4], [20, 20]);
    let points: Vec<V3> = points
        .iter()
        .map(|p| p + V3::new(-0.2, -0.2, 0.11))
        .collect();
    let material = Material {
        drag: 1.0,
        damping: 0.01,
        radius: 0.002,
        ..Material::sheet(5e-4, 1e6, 0.3)
    };
    let cloth = Deformable::cloth(&points, &triangles, true, 0.2, material).unwrap();
    let mut parts = [cloth];
    let mut kept = Vec::new();
    let mut last = f64::MAX;
    for _ in 0..600 {
        let obstacle = Surface::Obstacle(V3::zeros());
        let mut contacts = on_sphere(&parts[0], V3::zeros(), 0.1, obstacle, 0.5);
        Contact::carry_on(&mut contacts, &mut kept);
        assert!(solve(&mut parts, &mut [], &mut contacts, step(0.005)));
        kept = contacts;
        let height = parts[0].points().iter().map(|p| p.z).sum::<f64>();
        let energy = parts[0].energy() + 0.2 * 0.16 / 441.0 * GRAVITY * height;
        assert!(energy < last + 1e-3, "{energy} {last}");
        last = energy;
    }
    let pressed: V3 = kept
        .iter()
        .map(|contact| contact.touch.impulse / 0.005)
        .sum();
    near(pressed.z, 0.2 * 0.16 * GRAVITY, 0.02);
    let fastest = parts[0]
        .velocities()
        .iter()
        .map(V3::norm)
        .fold(0.0, f64::max);
    assert!(fastest < 0.02, "{fastest}");
    let nearest = parts[0]
        .points()
        .iter()
        .map(V3::norm)
        .fold(f64::MAX, f64::min);
    assert!((0.1015..0.1025).contains(&nearest), "{nearest}");
}

/// A ball that falls onto a sheet held at its rim comes to rest there, and the rim bears both.
#[test]
fn a_sheet_bears_a_body() {
    let (points, triangles) = sheet([0.4, 0.4], [12, 12]);
    let points: Vec<V3> = points.iter().map(|p| p - V3::new(0.2, 0.2, 0.0)).collect();
    let material = Material {
        drag: 0.5,
        damping: 0.01,
        radius: 0.002,
        ..Material::sheet(1e-3, 1e6, 0.3)
    };
    let mut cloth = Deformable::cloth(&points, &triangles, true, 0.3, material).unwrap();
    hold_at_rest(&mut cloth, |place| {
        place.x.abs().max(place.y.abs()) > 0.2 - 1e-9
    });
    let mut response = Matrix6::identity() / 0.5;
    (3..6).for_each(|axis| response[(axis, axis)] = 1.0 / (0.4 * 0.5 * 0.0025));
    let mut bodies = [Body::new(V3::z() * 0.06, Vector6::zeros(), response)];
    let (mut parts, mut kept) = ([cloth], Vec::new());
    for _ in 0..800 {
        bodies[0].velocity[2] -= GRAVITY * 0.005;
        let mut contacts = on_sphere(&parts[0], bodies[0].com, 0.05, Surface::Body(0), 0.5);
        Contact::carry_on(&mut contacts, &mut kept);
        assert!(solve(&mut parts, &mut bodies, &mut contacts, step(0.005)));
        kept = contacts;
        let body = &mut bodies[0];
        body.velocity += body.response * body.impulse;
        body.com += V3::from(body.velocity.fixed_rows::<3>(0)) * 0.005;
    }
    near(bodies[0].impulse[2] / 0.005, 0.5 * GRAVITY, 0.01);
    let borne: f64 = parts[0].holds.iter().map(|hold| hold.force.z).sum();
    near(borne, (0.5 + 0.3 * 0.16) * GRAVITY, 0.02);
    assert!(
        bodies[0].com.z < 0.05 && bodies[0].com.z > -0.05,
        "{}",
        bodies[0].com
    );
    assert!(bodies[0].velocity.norm() < 0.01);
}

#[test]
fn a_held_body_swings_with_the_cloth_and_momentum_is_kept() {
    let (points, triangles) = sheet([0.2, 0.2], [4, 4]);
    let material = Material::sheet(1e-3, 1e6, 0.3);
    let mut cloth = Deformable::cloth(&points, &triangles, true, 0.5, material).unwrap();
    let thrown: Vec<V3> = points.iter().map(|p| V3::new(0.1, p.x, 0.3)).collect();
    cloth.set_motion(&points, &thrown);
    let mut bodies = [Body::new(
        V3::zeros(),
        Vector6::zeros(),
        Matrix6::identity() * 20.0,
    )];
    cloth
        .holds
        .push(Hold::new(0, Target::Body(0, V3::zeros()), None));
    let mut parts = [cloth];
    let momentum = |parts: &[Deformable; 1], body: &Body| {
        // Nodes of the corners bear a sixth or a third of a cell; the sum of all is wanted.
        let masses = lumped(&points, &triangles, 0.5);
        let own: V3 = parts[0]
            .velocities()
            .iter()
            .zip(&masses)
            .map(|(v, m)| v * *m)
            .sum();
        own + V3::from(body.velocity.fixed_rows::<3>(0)) * 0.05
    };
    let start = momentum(&parts, &bodies[0]);
    for _ in 0..100 {
        bodies[0].impulse = Vector6::zeros();
        assert!(solve(&mut parts, &mut bodies, &mut [], weightless(0.002)));
        let body = &mut bodies[0];
        body.velocity += body.response * body.impulse;
        body.com += V3::from(body.velocity.fixed_rows::<3>(0)) * 0.002;
        for hold in &mut parts[0].holds {
            hold.target = Target::Body(0, V3::zeros());
        }
    }
    let end = momentum(&parts, &bodies[0]);
    assert!((end - start).norm() < 1e-3 * start.norm(), "{start} {end}");
    assert!((parts[0].points()[0] - bodies[0].com).norm() < 1e-4);
}

fn lumped(points: &[V3], triangles: &[[usize; 3]], density: f64) -> Vec<f64> {
    let mut masses = vec![0.0; points.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|node| points[node]);
        let third = (b - a).cross(&(c - a)).norm() * density / 6.0;
        triangle.iter().for_each(|node| masses[*node] += third);
    }
    masses
}

#[test]
fn a_cloth_does_not_pass_through_itself() {
    // A strip hangs over a line and falls onto its own lower half.
    let (points, triangles) = sheet([0.3, 0.1], [18, 6]);
    let folded: Vec<V3> = points
        .iter()
        .map(|p| {
            if p.x > 0.15 {
                V3::new(0.3 - p.x, p.y + 0.007, 0.06 - (0.2 - p.x).max(0.0))
            } else {
                *p
            }
        })
        .collect();
    let material = Material {
        drag: 2.0,
        radius: 0.002,
        ..Material::sheet(1e-3, 2e5, 0.3)
    };
    let mut cloth = Deformable::cloth(&points, &triangles, true, 0.3, material).unwrap();
    cloth.set_motion(&folded, &vec![V3::zeros(); folded.len()]);
    hold_at_rest(&mut cloth, |place| place.z < 1e-9 && place.x < 0.12);
    let (mut parts, mut kept) = ([cloth], Vec::new());
    for _ in 0..300 {
        let mut contacts = nearby(&parts, 1e-3, 0.005, |_, _| Some(0.3));
        Contact::carry_on(&mut contacts, &mut kept);
        assert!(solve(&mut parts, &mut [], &mut contacts, step(0.005)));
        kept = contacts;
    }
    let upper = parts[0]
        .points()
        .iter()
        .enumerate()
        .filter(|(node, _)| node % 19 >= 13);
    for (node, place) in upper {
        let is_above = place.x > 0.0 && place.x < 0.12 && (0.0..=0.1).contains(&place.y);
        assert!(!is_above || place.z > 0.003, "{node}: {place}");
    }
    assert!(
        kept.iter()
            .any(|contact| contact.touch.impulse.norm() > 0.0)
    );
}

#[test]
fn what_is_pulled_too_hard_tears() {
    let (points, triangles) = sheet([0.1, 0.2], [4, 8]);
    let upright: Vec<V3> = points.iter().map(|p| V3::new(p.x, 0.0, p.y)).collect();
    let material = Material {
        damping: 0.01,
        strength: 1.5,
        ..Material::sheet(1e-3, 1e6, 0.3)
    };
    let mut cloth = Deformable::cloth(&upright, &triangles, true, 1.0, material).unwrap();
    hold_at_rest(&mut cloth, |place| place.z > 0.2 - 1e-9);
    let cloth = run(cloth, 200);
    // The weight below the top row is 1.9 N/m.
    assert!((0..8).any(|i| cloth.is_torn(triangles.len() - 1 - i)));
    assert!(cloth.points()[0].z < -0.5);
}

#[test]
fn the_same_calls_have_the_same_bits() {
    let result = || {
        let (points, tetrahedra) = block(V3::new(0.1, 0.1, 0.1), [3, 3, 3]);
        let material = Material {
            damping: 0.001,
            ..Material::solid(1e5, 0.4)
        };
        let mut part = Deformable::volume(
            &points,
            &tetrahedra,
            &surface_of(&tetrahedra),
            1000.0,
            material,
        )
        .unwrap();
        hold_at_rest(&mut part, |place| place.z > 0.1 - 1e-9);
        run(part, 50).points().to_vec()
    };
    assert_eq!(result(), result());
}

#[test]
fn what_is_pressed_flat_comes_back() {
    let (points, tetrahedra) = block(V3::new(0.1, 0.1, 0.1), [3, 3, 3]);
    let material = Material {
        damping: 0.02,
        drag: 1.0,
        ..Material::solid(1e5, 0.3)
    };
    let mut part = Deformable::volume(
        &points,
        &tetrahedra,
        &surface_of(&tetrahedra),
        1000.0,
        material,
    )
    .unwrap();
    let start = part.enclosed();
    near(start, 1e-3, 1e-9);
    let flat: Vec<V3> = points
        .iter()
        .map(|p| V3::new(p.x, p.y, -0.1 * p.z))
        .collect();
    part.set_motion(&flat, &vec![V3::zeros(); points.len()]);
    near(run(part, 600).enclosed(), start, 0.02);
}

#[test]
fn what_is_no_mesh_is_refused() {
    let (points, triangles) = sheet([0.1, 0.1], [1, 1]);
    let material = Material::sheet(1e-3, 1e6, 0.3);
    let is_made = |points: &[V3], triangles: &[[usize; 3]]| {
        Deformable::cloth(points, triangles, true, 1.0, material).is_some()
    };
    assert!(is_made(&points, &triangles));
    assert!(!is_made(&points, &[[0, 1, 7]]));
    assert!(!is_made(&points, &[[0, 1, 1]]));
    assert!(!is_made(&points, &triangles[..1]));
    assert!(!is_made(&[], &[]));
    let (points, tetrahedra) = block(V3::new(0.1, 0.1, 0.1), [1, 1, 1]);
    let turned: Vec<[usize; 4]> = tetrahedra
        .iter()
        .map(|[a, b, c, d]| [*b, *a, *c, *d])
        .collect();
    assert!(Deformable::volume(&points, &turned, &surface_of(&turned), 1000.0, material).is_none());
}

#[test]
fn what_has_nothing_to_do_with_each_other_has_the_same_bits_alone() {
    let made = |x: f64| {
        let (points, triangles) = sheet([0.2, 0.2], [4, 4]);
        let points: Vec<V3> = points.iter().map(|p| p + V3::x() * x).collect();
        let material = Material::sheet(1e-3, 1e6, 0.3);
        Deformable::cloth(&points, &triangles, true, 0.5, material).unwrap()
    };
    let body = |x: f64| Body::new(V3::x() * x, Vector6::zeros(), Matrix6::identity() * 20.0);
    let run = |places: &[f64]| {
        let mut parts: Vec<Deformable> = places.iter().map(|x| made(*x)).collect();
        // The bodies are in the other order, so that islands have to find theirs.
        let mut bodies: Vec<Body> = places.iter().rev().map(|x| body(*x)).collect();
        for _ in 0..20 {
            for (number, part) in parts.iter_mut().enumerate() {
                let target = Target::Body(places.len() - 1 - number, V3::zeros());
                part.holds = vec![Hold::new(0, target, None)];
            }
            assert!(solve(&mut parts, &mut bodies, &mut [], step(0.005)));
            for body in &mut bodies {
                body.velocity += body.response * body.impulse;
                body.com += V3::from(body.velocity.fixed_rows::<3>(0)) * 0.005;
            }
        }
        let impulses: Vec<Vector6<f64>> = bodies.iter().map(|body| body.impulse).collect();
        (
            parts
                .iter()
                .map(|part| part.points().to_vec())
                .collect::<Vec<_>>(),
            impulses,
        )
    };
    let (both, impulses) = run(&[0.0, 3.0]);
    let (first, first_impulse) = run(&[0.0]);
    let (second, second_impulse) = run(&[3.0]);
    assert_eq!(both, [first[0].clone(), second[0].clone()]);
    assert_eq!(impulses, [second_impulse[0], first_impulse[0]]);
    assert!(impulses[0].norm() > 0.0);
}
