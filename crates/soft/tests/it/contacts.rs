//! Rods that touch things and each other.

use std::f64::consts::PI;

use super::bodies::{advance, ball, fall};
use super::*;
use soft::{Surface, between};

/// Contacts of nodes with a plane.
fn on_floor(rod: &Rod, friction: f64) -> Vec<Contact> {
    let near = |node: &usize| rod.point(*node).z < rod.material.radius + 0.05;
    let contact = |node: usize| Contact {
        rod: 0,
        edge: node.min(rod.len() - 2),
        weight: if node == rod.len() - 1 { 1.0 } else { 0.0 },
        surface: Surface::Obstacle(V3::zeros()),
        touch: Touch::new(
            V3::new(rod.point(node).x, rod.point(node).y, 0.0),
            V3::z(),
            friction,
        ),
        key: u64::from(node == rod.len() - 1),
    };
    (0..rod.len()).filter(near).map(contact).collect()
}

/// Contacts of edges with a cylinder about the y axis.
fn on_cylinder(rod: &Rod, radius: f64, friction: f64) -> Vec<Contact> {
    let contact = |edge: usize| {
        let [a, b] = [rod.point(edge), rod.point(edge + 1)].map(|p| V3::new(p.x, 0.0, p.z));
        let along = b - a;
        let weight = (-a.dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
        let nearest = a + along * weight;
        let normal = nearest.normalize();
        (nearest.norm() < radius + rod.material.radius + 0.01).then(|| Contact {
            rod: 0,
            edge,
            weight,
            surface: Surface::Obstacle(V3::zeros()),
            touch: Touch::new(normal * radius, normal, friction),
            key: 0,
        })
    };
    (0..rod.len() - 1).filter_map(contact).collect()
}

#[test]
fn a_rope_falls_on_the_floor_and_lies_still() {
    let mut rod = Rod::new(
        &line(V3::new(0.0, 0.0, 0.2), V3::new(1.0, 0.0, 0.3), 40),
        None,
        true,
        Material {
            bend: 1e-5,
            ..rope()
        },
    )
    .unwrap();
    rod.material.damping = 1e-3;
    let (mut rods, mut kept) = ([rod], Vec::new());
    let mut lowest = 1.0_f64;
    for _ in 0..400 {
        let contacts = on_floor(&rods[0], 0.5);
        run_in_contact(&mut rods, &mut [], &mut kept, contacts, step(0.005));
        lowest = rods[0].points().map(|p| p.z).fold(lowest, f64::min);
    }
    assert!(lowest > 0.0, "{lowest}");
    let resting: Vec<V3> = rods[0].points().collect();
    for _ in 0..400 {
        let contacts = on_floor(&rods[0], 0.5);
        run_in_contact(&mut rods, &mut [], &mut kept, contacts, step(0.005));
    }
    let crept = rods[0]
        .points()
        .zip(&resting)
        .map(|(a, b)| (a - b).norm())
        .fold(0.0, f64::max);
    assert!(crept < 1e-5, "{crept}");
    let pressed: f64 = kept
        .iter()
        .map(|contact| contact.touch.impulse.z / 0.005)
        .sum();
    near(pressed, 0.05 * 1.005 * GRAVITY, 0.02);
}

/// Ratio of the tensions of a rope that is drawn over half of a cylinder.
fn capstan(friction: f64) -> f64 {
    let radius = 0.05;
    let outer = radius + rope().radius;
    let mut points = line(V3::new(-outer, 0.0, -0.3), V3::new(-outer, 0.0, 0.0), 30);
    points.pop();
    points.extend((0..=16).map(|i| {
        let angle = PI * f64::from(i) / 16.0;
        V3::new(-outer * libm::cos(angle), 0.0, outer * libm::sin(angle))
    }));
    points.pop();
    points.extend(line(
        V3::new(outer, 0.0, 0.0),
        V3::new(outer, 0.0, -0.1),
        10,
    ));
    let last = points.len() - 1;
    let material = Material {
        damping: 1e-3,
        drag: 1.0,
        ..rope()
    };
    let mut rod = Rod::new(&points, None, true, material).expect("the points are apart");
    let mut bodies = [ball(points[0], 1.0, 0.05)];
    rod.holds
        .push(Hold::new(0, Target::Body(0, V3::zeros()), None));
    let mut pulled = rod.point(last);
    rod.holds.push(Hold::new(last, Target::Place(pulled), None));
    let (mut rods, mut kept) = ([rod], Vec::new());
    let (mut sums, mut count) = ([0.0; 2], 0.0);
    for i in 0..600 {
        pulled.z -= 0.05 * 0.005;
        rods[0].holds[1].target = Target::Place(pulled);
        fall(&mut bodies[0], 0.005, 1.0);
        let contacts = on_cylinder(&rods[0], radius, friction);
        run_in_contact(&mut rods, &mut bodies, &mut kept, contacts, step(0.005));
        advance(&mut bodies[0], 0.005);
        if i >= 300 {
            sums[0] += rods[0].tensions()[5];
            sums[1] += rods[0].tensions()[last - 2];
            count += 1.0;
        }
    }
    // The rope itself weighs little against the kilogram.
    near(sums[0] / count, 1.0 * GRAVITY, 0.05);
    sums[1] / sums[0]
}

#[test]
fn a_rope_around_a_cylinder_follows_the_capstan_equation() {
    for friction in [0.0, 0.2, 0.4] {
        near(capstan(friction), libm::exp(friction * PI), 0.04);
    }
}

#[test]
fn a_rope_that_is_laid_over_a_body_pushes_it_down() {
    // A ball that carries the middle of a rope between two places, from below.
    let mut rod = Rod::new(
        &line(V3::zeros(), V3::x(), 20),
        None,
        true,
        Material {
            drag: 2.0,
            ..rope()
        },
    )
    .unwrap();
    hold(&mut rod, 0);
    hold(&mut rod, 20);
    let mut bodies = [ball(V3::new(0.5, 0.0, 0.05), 0.3, 0.03)];
    let (mut rods, mut kept) = ([rod], Vec::new());
    for _ in 0..600 {
        fall(&mut bodies[0], 0.005, 2.0);
        let contact = Contact {
            rod: 0,
            edge: 10,
            weight: 0.0,
            surface: Surface::Body(0),
            touch: Touch::new(bodies[0].com - V3::z() * 0.045, -V3::z(), 0.5),
            key: 3,
        };
        run_in_contact(
            &mut rods,
            &mut bodies,
            &mut kept,
            vec![contact],
            step(0.005),
        );
        advance(&mut bodies[0], 0.005);
        // It does not roll off.
        bodies[0].velocity[3] = 0.0;
        bodies[0].velocity[4] = 0.0;
    }
    near(-kept[0].touch.impulse.z / 0.005, 0.3 * GRAVITY, 0.02);
    near(bodies[0].impulse[2] / 0.005, 0.3 * GRAVITY, 0.02);
}

#[test]
fn ropes_lie_across_each_other() {
    let lower = Rod::new(
        &line(V3::zeros(), V3::x() * 0.4, 16),
        None,
        true,
        Material {
            drag: 2.0,
            ..rope()
        },
    );
    let upper = Rod::new(
        &line(V3::new(0.2, -0.2, 0.02), V3::new(0.2, 0.2, 0.02), 16),
        None,
        true,
        Material {
            drag: 2.0,
            ..rope()
        },
    );
    let mut rods = [lower.unwrap(), upper.unwrap()];
    hold(&mut rods[0], 0);
    hold(&mut rods[0], 16);
    let mut kept = Vec::new();
    for _ in 0..600 {
        let contacts = between(&rods, 0.01, |_, _| Some(0.5));
        run_in_contact(&mut rods, &mut [], &mut kept, contacts, step(0.005));
    }
    let along = |rod: &Rod| -> Vec<V3> {
        let points: Vec<V3> = rod.points().collect();
        let edges = points.windows(2);
        edges.flat_map(|pair| line(pair[0], pair[1], 50)).collect()
    };
    let (lower, upper) = (along(&rods[0]), along(&rods[1]));
    let pairs = lower
        .iter()
        .flat_map(|a| upper.iter().map(move |b| (a - b).norm()));
    let apart = pairs.fold(1.0, f64::min);
    assert!((apart - 0.004).abs() < 3e-4, "{apart}");
    let pressed: f64 = kept
        .iter()
        .map(|contact| contact.touch.impulse.z / 0.005)
        .sum();
    near(pressed.abs(), 0.05 * 0.4 * GRAVITY, 0.05);
}

#[test]
fn a_loop_of_rope_does_not_pass_through_itself() {
    // One end is drawn across the other part, which is held.
    let mut points = line(V3::zeros(), V3::x() * 0.3, 15);
    points.extend((1..=8).map(|i| {
        let angle = PI * f64::from(i) / 8.0;
        V3::new(
            0.3 + 0.05 * libm::sin(angle),
            0.05 - 0.05 * libm::cos(angle),
            0.0,
        )
    }));
    points.extend(line(V3::new(0.28, 0.1, 0.0), V3::new(0.1, 0.1, 0.0), 9));
    let last = points.len() - 1;
    let mut rod = Rod::new(
        &points,
        None,
        false,
        Material {
            bend: 1e-6,
            ..rope()
        },
    )
    .unwrap();
    (0..12).for_each(|node| hold(&mut rod, node));
    let mut end = rod.point(last);
    rod.holds.push(Hold::new(last, Target::Place(end), None));
    let (mut rods, mut kept) = ([rod], Vec::new());
    for _ in 0..200 {
        end.y -= 0.001;
        rods[0].holds[12].target = Target::Place(end);
        let contacts = between(&rods, 0.01, |_, _| Some(0.3));
        run_in_contact(&mut rods, &mut [], &mut kept, contacts, weightless(0.005));
    }
    let nearest = (0..12)
        .flat_map(|i| (25..last).map(move |j| (i, j)))
        .map(|(i, j)| (rods[0].point(i) - rods[0].point(j)).norm())
        .fold(1.0, f64::min);
    assert!(!kept.is_empty() && nearest > 0.003, "{nearest}");
}
