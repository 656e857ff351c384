//! Cloths and volumes beside closed forms, and what they bear.

use soft::V3;
use soft::fem::{Deformable, Material};

use super::{block, hanging_sheet, hold_at_rest, run, run_under, sheet, solid, sphere, surface_of};
use crate::{GRAVITY, near, step, weightless};

#[test]
fn a_sheet_is_stretched_by_what_hangs_from_it() {
    let material = Material {
        damping: 0.05,
        drag: 2.0,
        ..Material::sheet(1e-3, 1e5, 0.0)
    };
    let cloth = run(hanging_sheet(material).0, 600);
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
        let mesh = block(V3::new(0.2, 0.04, 0.04), [5 * layers, layers, layers]);
        let material = Material {
            damping: 0.02,
            drag: 2.0,
            ..Material::solid(1e6, 0.0)
        };
        let mut beam = solid(mesh, 1000.0, material);
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

#[test]
fn what_is_pulled_too_hard_tears() {
    let material = Material {
        damping: 0.01,
        strength: 1.5,
        ..Material::sheet(1e-3, 1e6, 0.3)
    };
    let (cloth, triangles) = hanging_sheet(material);
    let cloth = run(cloth, 200);
    // The weight below the top row is 1.9 N/m.
    assert!((0..8).any(|i| cloth.is_torn(triangles - 1 - i)));
    assert!(cloth.points()[0].z < -0.5);
}

#[test]
fn what_is_pressed_flat_comes_back() {
    let mesh = block(V3::new(0.1, 0.1, 0.1), [3, 3, 3]);
    let material = Material {
        damping: 0.02,
        drag: 1.0,
        ..Material::solid(1e5, 0.3)
    };
    let mut part = solid(mesh, 1000.0, material);
    let start = part.enclosed();
    near(start, 1e-3, 1e-9);
    let flat: Vec<V3> = part
        .points()
        .iter()
        .map(|p| V3::new(p.x, p.y, -0.1 * p.z))
        .collect();
    part.set_motion(&flat, &vec![V3::zeros(); flat.len()]);
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
