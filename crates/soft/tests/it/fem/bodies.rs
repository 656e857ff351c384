//! Cloths and volumes with rigid bodies.

use nalgebra::{Matrix6, Vector6};
use soft::fem::{Contact, Deformable, Material, Parts, Surface, solve};
use soft::{Body, Hold, Target, V3};

use super::contacts::on_sphere;
use super::{block, hold_at_rest, run, sheet, solid};
use crate::{GRAVITY, near, step, weightless};

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
        assert!(solve(
            Parts::without_rods(&mut parts, &mut contacts),
            &mut bodies,
            step(0.005)
        ));
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
        assert!(solve(
            Parts::without_rods(&mut parts, &mut []),
            &mut bodies,
            weightless(0.002)
        ));
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
fn the_same_calls_have_the_same_bits() {
    let result = || {
        let mesh = block(V3::new(0.1, 0.1, 0.1), [3, 3, 3]);
        let material = Material {
            damping: 0.001,
            ..Material::solid(1e5, 0.4)
        };
        let mut part = solid(mesh, 1000.0, material);
        hold_at_rest(&mut part, |place| place.z > 0.1 - 1e-9);
        run(part, 50).points().to_vec()
    };
    assert_eq!(result(), result());
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
            assert!(solve(
                Parts::without_rods(&mut parts, &mut []),
                &mut bodies,
                step(0.005)
            ));
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
