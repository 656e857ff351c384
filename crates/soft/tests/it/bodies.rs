//! Rods and rigid bodies.

use nalgebra::{Matrix6, Vector6};

use super::*;

/// A ball of a mass and a radius of gyration.
pub(crate) fn ball(com: V3, mass: f64, radius: f64) -> Body {
    let mut response = Matrix6::identity() / mass;
    for axis in 3..6 {
        response[(axis, axis)] /= radius * radius;
    }
    Body::new(com, Vector6::zeros(), response)
}

/// The velocity that a body would have at the end of the step under gravity.
pub(crate) fn fall(body: &mut Body, step: f64, drag: f64) {
    body.velocity /= 1.0 + drag * step;
    body.velocity[2] -= GRAVITY * step;
}

/// Moves a body that has received its impulse; it does not turn.
pub(crate) fn advance(body: &mut Body, step: f64) {
    body.velocity += body.response * body.impulse;
    body.com += V3::from(body.velocity.fixed_rows::<3>(0)) * step;
}

#[test]
fn a_rope_holds_a_weight_of_any_mass() {
    for mass in [1e-4, 0.01, 1.0, 100.0, 1e3] {
        let mut rod = Rod::new(
            &line(V3::zeros(), V3::z() * -0.5, 20),
            None,
            true,
            Material {
                drag: 3.0,
                ..rope()
            },
        )
        .unwrap();
        hold(&mut rod, 0);
        let mut bodies = [ball(rod.point(20), mass, 0.05)];
        rod.holds
            .push(Hold::new(20, Target::Body(0, V3::zeros()), None));
        let mut rods = [rod];
        for _ in 0..1000 {
            fall(&mut bodies[0], 0.005, 5.0);
            assert!(solve(&mut rods, &mut bodies, &mut [], step(0.005)));
            advance(&mut bodies[0], 0.005);
        }
        let weight = mass * GRAVITY;
        near(
            rods[0].tensions()[19],
            weight + 0.05 * GRAVITY * 0.0125,
            0.01,
        );
        assert!(
            bodies[0].velocity.norm() < 1e-3,
            "{mass}: {}",
            bodies[0].velocity
        );
        near(bodies[0].com.z, -0.5 * (1.0 + weight / 1e5), 0.01);
    }
}

#[test]
fn a_rope_and_a_body_keep_their_momentum() {
    let mut rod = Rod::new(&line(V3::zeros(), V3::x() * 0.5, 20), None, true, rope()).unwrap();
    let mut bodies = [ball(V3::new(0.5, 0.0, 0.1), 0.02, 0.1)];
    bodies[0].velocity = Vector6::new(0.5, 1.0, -2.0, 0.0, 0.0, 0.0);
    rod.holds.push(Hold::new(
        20,
        Target::Body(0, V3::new(0.0, 0.0, -0.1)),
        None,
    ));
    let mut rods = [rod];
    let mut mean = V3::zeros();
    for i in 0..600 {
        assert!(solve(&mut rods, &mut bodies, &mut [], weightless(0.005)));
        let Target::Body(_, lever) = &mut rods[0].holds[0].target else {
            unreachable!()
        };
        advance(&mut bodies[0], 0.005);
        let turned = V3::from(bodies[0].velocity.fixed_rows::<3>(3)) * 0.005;
        *lever = nalgebra::Rotation3::new(turned) * *lever;
        let rod = &rods[0];
        let of_rod: V3 = (0..rod.len()).map(|i| rod.velocity(i) * rod.mass(i)).sum();
        let of_body = V3::from(bodies[0].velocity.fixed_rows::<3>(0)) * 0.02;
        if i >= 300 {
            mean += (of_rod + of_body) / 300.0;
        }
    }
    // Of single steps it differs while the rope vibrates: the rope looks back two steps, the body one.
    let expected = V3::new(0.5, 1.0, -2.0) * 0.02;
    assert!((mean - expected).norm() < 0.01 * expected.norm(), "{mean}");
}

#[test]
fn what_is_held_fast_does_not_give_way() {
    let mut rod = Rod::new(
        &line(V3::zeros(), V3::x(), 20),
        None,
        true,
        Material {
            drag: 20.0,
            ..rope()
        },
    )
    .unwrap();
    hold(&mut rod, 0);
    let held = Body::new(V3::x(), Vector6::zeros(), Matrix6::zeros());
    rod.holds
        .push(Hold::new(20, Target::Body(0, V3::zeros()), None));
    let (mut rods, mut bodies) = ([rod], [held]);
    for _ in 0..2000 {
        assert!(solve(&mut rods, &mut bodies, &mut [], step(0.005)));
    }
    near(-bodies[0].impulse[2] / 0.005, 0.05 * GRAVITY / 2.0, 0.01);
    assert!((rods[0].point(20) - V3::x()).norm() < 1e-6);
}

#[test]
fn a_clamped_rod_turns_a_body() {
    // A body at the end of a rod that is clamped in it: the weight at an arm is a torque on the rod's root.
    let material = Material {
        bend: 1.0,
        twist: 1.0,
        drag: 5.0,
        ..rope()
    };
    let mut rod = Rod::new(&line(V3::zeros(), V3::x() * 0.4, 20), None, true, material).unwrap();
    clamp(&mut rod, 0);
    let mut bodies = [ball(V3::new(0.4, 0.1, 0.0), 0.1, 0.05)];
    let direction = Some(rod.direction(19));
    rod.holds.push(Hold::new(
        19,
        Target::Body(0, V3::new(-0.02, -0.1, 0.0)),
        direction,
    ));
    rod.holds.push(Hold::new(
        20,
        Target::Body(0, V3::new(0.0, -0.1, 0.0)),
        None,
    ));
    let mut rods = [rod];
    for _ in 0..2000 {
        fall(&mut bodies[0], 0.005, 5.0);
        assert!(solve(&mut rods, &mut bodies, &mut [], step(0.005)));
        advance(&mut bodies[0], 0.005);
        let turned =
            nalgebra::Rotation3::new(V3::from(bodies[0].velocity.fixed_rows::<3>(3)) * 0.005);
        for hold in &mut rods[0].holds[2..] {
            let Target::Body(_, lever) = &mut hold.target else {
                unreachable!()
            };
            *lever = turned * *lever;
            hold.direction = hold.direction.map(|direction| turned * direction);
        }
    }
    // Twisted by the weight beside the axis.
    near(rods[0].holds[0].torque.x.abs(), 0.1 * GRAVITY * 0.1, 0.03);
    let lever = rods[0].holds[0].force * -0.02;
    assert!(lever.norm() > 0.0);
    let vertical = rods[0].holds[0].force.z + rods[0].holds[1].force.z;
    near(vertical, 0.1 * GRAVITY + 0.02 * GRAVITY, 0.01);
}
