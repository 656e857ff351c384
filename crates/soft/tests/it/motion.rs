//! Periods, waves, energy.

use std::f64::consts::PI;

use super::*;

/// Times at which a quantity passes zero, by interpolation.
fn passages(values: &[f64], step: f64) -> Vec<f64> {
    let pairs = values.windows(2).enumerate();
    pairs
        .filter(|(_, pair)| pair[0] * pair[1] < 0.0)
        .map(|(i, pair)| step * (i as f64 + pair[0] / (pair[0] - pair[1])))
        .collect()
}

fn period(values: &[f64], step: f64) -> f64 {
    let passages = passages(values, step);
    let count = passages.len() - 1;
    2.0 * (passages[count] - passages[0]) / count as f64
}

#[test]
fn a_hanging_rope_swings_with_its_period() {
    let edges = 50;
    // Its first mode is a Bessel function: j0(2.4048 sqrt(z)) with the height z above the free end.
    let bessel = |x: f64| libm::j0(x);
    let points: Vec<V3> = (0..=edges)
        .map(|i| {
            let height = 1.0 - f64::from(i) / f64::from(edges);
            V3::new(0.01 * bessel(2.404826 * height.sqrt()), 0.0, height)
        })
        .collect();
    let mut rod = Rod::new(&points, Some(1.0), true, rope()).unwrap();
    hold(&mut rod, 0);
    let mut rods = [rod];
    let mut ends = Vec::new();
    for _ in 0..2000 {
        run(&mut rods, step(0.005), 1);
        ends.push(rods[0].point(50).x);
    }
    near(
        period(&ends, 0.005),
        4.0 * PI / 2.404826 / GRAVITY.sqrt(),
        0.005,
    );
    let late = ends[1500..]
        .iter()
        .fold(0.0_f64, |most, x| most.max(x.abs()));
    near(late, 0.01, 0.05);
}

#[test]
fn waves_run_along_a_string_with_their_speed() {
    let (edges, tension) = (50, 5.0);
    let material = Material {
        stretch: 1000.0,
        ..rope()
    };
    let points: Vec<V3> = (0..=edges)
        .map(|i| {
            let x = f64::from(i) / f64::from(edges);
            V3::new(2.0 * x, 0.0, 1e-3 * libm::sin(PI * x))
        })
        .collect();
    let mut rod = Rod::new(
        &points,
        Some(2.0 / (1.0 + tension / 1000.0)),
        true,
        material,
    )
    .unwrap();
    hold(&mut rod, 0);
    hold(&mut rod, 50);
    let mut rods = [rod];
    let mut middle = Vec::new();
    for _ in 0..400 {
        run(&mut rods, weightless(0.005), 1);
        middle.push(rods[0].point(25).z);
    }
    // The mass of a metre of the stretched string.
    let speed = (tension / (0.05 / (1.0 + tension / 1000.0))).sqrt();
    near(period(&middle, 0.005), 4.0 / speed, 0.01);
}

#[test]
fn energy_does_not_grow() {
    for (bend, twist, stretch) in [
        (1e-8, 1e-8, 1e5),
        (1e-3, 1e-3, 1e4),
        (0.1, 0.1, 1e3),
        (1e-5, 1e-4, 1e7),
    ] {
        let material = Material {
            bend,
            twist,
            stretch,
            ..rope()
        };
        let mut rod = Rod::new(&line(V3::zeros(), V3::x(), 40), None, true, material).unwrap();
        hold(&mut rod, 0);
        let mut rods = [rod];
        let weight = |rod: &Rod| -> f64 {
            rod.points()
                .enumerate()
                .map(|(i, p)| rod.mass(i) * GRAVITY * p.z)
                .sum()
        };
        let scale = 0.05 * GRAVITY * 0.5;
        let (mut least, mut last) = (f64::MAX, 0.0);
        for i in 0..2000 {
            run(&mut rods, step(0.005), 1);
            last = rods[0].energy() + weight(&rods[0]);
            assert!(last < 0.01 * scale, "{bend}: {last} at {i}");
            assert!(
                last < least + 0.05 * scale,
                "{bend}: {last} after {least} at {i}"
            );
            least = least.min(last);
        }
        println!(
            "bend {bend}: energy lost {:.3} of {scale:.3} in 10 s",
            -last
        );
    }
}

#[test]
fn a_free_rod_keeps_its_momentum_and_its_spin() {
    let material = Material {
        bend: 1.0,
        twist: 1.0,
        ..rope()
    };
    let mut rod = Rod::new(&line(V3::zeros(), V3::x(), 20), None, true, material).unwrap();
    let velocities: Vec<V3> = rod
        .points()
        .map(|p| V3::new(1.0, 0.0, 10.0 * (p.x - 0.5)))
        .collect();
    let points: Vec<V3> = rod.points().collect();
    rod.set_motion(&points, &velocities);
    let mut rods = [rod];
    run(&mut rods, weightless(0.005), 400);
    let rod = &rods[0];
    let momentum: V3 = (0..rod.len()).map(|i| rod.velocity(i) * rod.mass(i)).sum();
    assert!(
        (momentum - V3::new(0.05, 0.0, 0.0)).norm() < 1e-6,
        "{momentum}"
    );
    let about = |i: usize| (rod.point(i) - rod.point(10)).cross(&rod.velocity(i)) * rod.mass(i);
    let spin: V3 = (0..rod.len()).map(about).sum();
    near(spin.y.abs(), 10.0 * 0.05 / 12.0 * (1.0 + 1.0 / 200.0), 0.02);
}

#[test]
fn the_same_calls_have_the_same_bits() {
    let once = || {
        let mut rod = Rod::new(&line(V3::zeros(), V3::x(), 20), None, true, rope()).unwrap();
        hold(&mut rod, 0);
        let mut rods = [rod];
        run(&mut rods, step(0.005), 200);
        rods[0]
            .points()
            .map(|p| p.map(f64::to_bits))
            .collect::<Vec<_>>()
    };
    assert_eq!(once(), once());
}

#[test]
fn what_is_pulled_too_hard_breaks_once() {
    let material = Material {
        strength: 0.3,
        ..rope()
    };
    // It weighs 0.49 N.
    let mut rod = Rod::new(&line(V3::zeros(), V3::z() * -1.0, 20), None, true, material).unwrap();
    hold(&mut rod, 0);
    let mut rods = [rod];
    run(&mut rods, step(0.005), 100);
    let broken: Vec<usize> = (0..20).filter(|&edge| rods[0].is_broken(edge)).collect();
    assert_eq!(broken, [0]);
    assert!(rods[0].point(20).z < -1.5, "{}", rods[0].point(20));
    assert!(rods[0].point(0).norm() < 1e-6);
}

#[test]
fn what_is_held_far_away_comes_there_and_pulls_at_nothing_before() {
    let points = line(V3::zeros(), V3::x(), 40);
    let mut rod = Rod::new(&points, None, true, rope()).unwrap();
    rod.holds
        .push(Hold::new(0, Target::Place(V3::z() * 3.0), None));
    let mut rods = [rod];
    for _ in 0..400 {
        run(&mut rods, step(0.005), 1);
        assert!(rods[0].holds[0].force.norm() < 1e5);
    }
    assert!((rods[0].point(0) - V3::z() * 3.0).norm() < 1e-6);
}
