//! Forms at rest.

use std::f64::consts::PI;

use super::*;

/// A material that comes to rest soon.
fn calm(material: Material) -> Material {
    Material {
        drag: 5.0,
        damping: 0.01,
        ..material
    }
}

#[test]
fn a_rope_hangs_as_a_catenary() {
    // Length 1, span 0.7: a = 0.2311062, sag a (cosh(s / 2a) - 1).
    let (sag, parameter) = (0.319720494, 0.231106245);
    for edges in [20, 50, 100] {
        let mut points = line(V3::zeros(), V3::new(0.35, 0.0, -0.3570714), edges / 2);
        points.pop();
        points.extend(line(
            V3::new(0.35, 0.0, -0.3570714),
            V3::new(0.7, 0.0, 0.0),
            edges / 2,
        ));
        let mut rod = Rod::new(&points, Some(1.0), true, calm(rope())).unwrap();
        hold(&mut rod, 0);
        hold(&mut rod, edges);
        let mut rods = [rod];
        run(&mut rods, step(0.005), 1500);
        let lowest = rods[0].points().map(|p| p.z).fold(0.0, f64::min);
        near(-lowest, sag, 0.01);
        let horizontal = rope().line_density * GRAVITY * parameter;
        near(rods[0].tensions()[edges / 2], horizontal, 0.01);
        near(
            rods[0].holds[0].force.z,
            0.5 * rope().line_density * GRAVITY,
            0.01,
        );
    }
}

/// A weightless rod of length 1 that is clamped at one end, under a force at the other one: displacement of the end along and across, by
/// the load times length squared over bending stiffness.
fn cantilever(load: f64, edges: usize) -> (f64, f64) {
    let material = Material {
        stretch: 1e5,
        bend: 0.1,
        twist: 0.1,
        line_density: 1e-6,
        ..calm(rope())
    };
    // The clamped edge ends where the free length begins.
    let length = 1.0 / edges as f64;
    let points = line(V3::new(-length, 0.0, 0.0), V3::x(), edges + 1);
    let mut rod = Rod::new(&points, None, true, material).expect("the points are apart");
    clamp(&mut rod, 0);
    let mass = load * 0.1 / GRAVITY;
    let mut bodies = [free_body(rod.point(edges + 1), mass)];
    rod.holds
        .push(Hold::new(edges + 1, Target::Body(0, V3::zeros()), None));
    let mut rods = [rod];
    for _ in 0..3000 {
        fall(&mut bodies[0], 0.005, 5.0);
        assert!(solve(&mut rods, &mut bodies, &mut [], step(0.005)));
        move_body(&mut bodies[0], 0.005);
    }
    let end = rods[0].point(edges + 1);
    (1.0 - end.x, -end.z)
}

fn free_body(com: V3, mass: f64) -> Body {
    bodies::ball(com, mass, 0.01)
}

fn fall(body: &mut Body, step: f64, drag: f64) {
    bodies::fall(body, step, drag);
}

fn move_body(body: &mut Body, step: f64) {
    bodies::advance(body, step);
}

#[test]
fn a_cantilever_bends_a_little_as_the_beam_and_far_as_the_elastica() {
    let (_, small) = cantilever(0.03, 30);
    near(small, 0.03 / 3.0, 0.01);
    // K. Bisshopp and D. Drucker, Large deflection of cantilever beams, 1945: deflections for a load of 1, 2, 5, 10.
    let known = [
        (1.0, 0.05643, 0.30172),
        (2.0, 0.16064, 0.49346),
        (5.0, 0.38763, 0.71379),
        (10.0, 0.55500, 0.81061),
    ];
    for (load, along, across) in known {
        let (a, b) = cantilever(load, 30);
        near(a, along, 0.02);
        near(b, across, 0.01);
    }
}

#[test]
fn a_rod_buckles_at_eulers_load() {
    let (edges, bend) = (40, 0.1);
    let material = Material {
        stretch: 1e6,
        bend,
        twist: bend,
        ..calm(rope())
    };
    let mut points = line(V3::zeros(), V3::x(), edges);
    for point in &mut points {
        point.z = 1e-5 * libm::sin(PI * point.x);
    }
    let mut rod = Rod::new(&points, None, true, material).unwrap();
    hold(&mut rod, 0);
    hold(&mut rod, edges);
    rod.holds[1].target = Target::Place(V3::new(0.999, 0.0, 0.0));
    let mut rods = [rod];
    run(&mut rods, weightless(0.005), 2000);
    let middle = rods[0].point(edges / 2).z;
    assert!(middle.abs() > 0.01, "{middle}");
    near(-rods[0].holds[1].force.x, PI * PI * bend, 0.01);
}

#[test]
fn a_rod_that_is_turned_at_one_end_bears_a_torque() {
    let material = Material {
        bend: 0.5,
        twist: 0.2,
        ..calm(rope())
    };
    let mut rod = Rod::new(&line(V3::zeros(), V3::x() * 1.2, 24), None, true, material).unwrap();
    clamp(&mut rod, 0);
    clamp(&mut rod, 23);
    let direction = rod.direction(23);
    let mut rods = [rod];
    for i in 1..=2000 {
        // More than a turn.
        let angle = 8.0 * (f64::from(i) / 1000.0).min(1.0);
        let turned = direction * libm::cos(angle) + V3::x().cross(&direction) * libm::sin(angle);
        rods[0].holds[2].direction = Some(turned);
        run(&mut rods, weightless(0.005), 1);
    }
    // A metre turns freely: half an edge at each end is held.
    near(rods[0].holds[2].torque.x, 0.2 * 8.0 / 1.1, 0.01);
    near(rods[0].holds[0].torque.x, -0.2 * 8.0 / 1.1, 0.01);
}

#[test]
fn what_is_bent_at_rest_stays_bent() {
    let points: Vec<V3> = (0..=30)
        .map(|i| {
            let angle = f64::from(i) * 0.1;
            V3::new(libm::sin(angle), 0.3 * angle, 1.0 - libm::cos(angle)) * 0.1
        })
        .collect();
    let material = Material {
        bend: 0.1,
        twist: 0.1,
        ..calm(rope())
    };
    let mut rods = [Rod::new(&points, None, false, material).unwrap()];
    clamp(&mut rods[0], 0);
    run(&mut rods, weightless(0.005), 200);
    for (now, before) in rods[0].points().zip(&points) {
        assert!((now - before).norm() < 1e-7);
    }
}
