//! Particles: closed forms of flight and contact, what they do to bodies, the same bits again.

use scene::appearance::colour::Colour;
use scene::drawing::particles::options::{Parameters, ParticleFlags, ParticleKind};
use scene::drawing::particles::{Particle, ParticleStyle};
use scene::shape::{Material, Shape};

use super::*;

const RESPONDABLE: ParticleFlags =
    ParticleFlags::RESPONDABLE_1_TO_4.union(ParticleFlags::RESPONDABLE_5_TO_8);
/// Of the particles here: a centimetre wide, as heavy as water.
const MASS: f64 = 1000.0 * std::f64::consts::PI / 6.0 * 1e-6;

fn style(flags: ParticleFlags, parameters: &[f64]) -> ParticleStyle {
    ParticleStyle {
        kind: ParticleKind::Spheres,
        flags,
        size: 0.01,
        density: 1000.0,
        parameters: Parameters::from_numbers(parameters),
        life_time: 0.0,
        max_items: 1000,
        colour: Colour::new([1.0; 3]),
    }
}

/// A scene with a source of particles.
fn source(flags: ParticleFlags, parameters: &[f64]) -> (Bench, i64) {
    let mut bench = Bench::new();
    let particles = bench.scene.drawings_mut().particles_mut();
    let handle = particles.add(style(flags, parameters), 1);
    (bench, handle)
}

fn emit(bench: &mut Bench, source: i64, [x, y, z]: [f64; 3], [u, v, w]: [f64; 3]) {
    let object = bench.scene.drawings_mut().particles_mut().get_mut(source);
    assert!(object.expect("exists").add(&[x, y, z, u, v, w]));
}

fn all(bench: &Bench, source: i64) -> Vec<Particle> {
    let object = bench.scene.drawings().particles().get(source);
    object.expect("exists").items().copied().collect()
}

fn only(bench: &Bench, source: i64) -> Particle {
    let [particle] = all(bench, source)[..] else {
        panic!("one particle");
    };
    particle
}

fn floor_of(bench: &mut Bench, friction: f64, restitution: f64) -> Handle {
    let floor = bench.floor();
    bench.change(floor, |shape| {
        shape.material = Material::of_friction(friction);
        shape.material.restitution = restitution;
    });
    floor
}

#[test]
fn particles_fall_as_bodies_do() {
    let (mut bench, source) = source(ParticleFlags::empty(), &[]);
    emit(&mut bench, source, [0.0, 0.0, 10.0], [1.0, 0.0, 0.0]);
    bench.run(1);
    let particle = only(&bench, source);
    near(10.0 - particle.position[2], 0.013_488_751, 1e-7);
    near(particle.position[0], STEP, 1e-12);
    bench.run(19);
    near(10.0 - only(&bench, source).position[2], 4.929_525_2, 1e-5);
    // What is drawn is where they are.
    let (_, drawing) = bench.scene.drawings().iter().next().expect("drawn");
    let item = drawing.items().next().expect("an item");
    assert_eq!(item.points(), [only(&bench, source).position]);
}

#[test]
fn gravity_does_not_pull_where_flags_say_so() {
    let (mut bench, source) = source(ParticleFlags::IGNORES_GRAVITY, &[]);
    emit(&mut bench, source, [0.0, 0.0, 1.0], [0.0, 0.0, 0.5]);
    bench.run(20);
    near(only(&bench, source).position[2], 1.5, 1e-9);
}

/// The speed at which drag bears the weight: with linear drag c v = m g, with quadratic drag c v² = m g.
#[test]
fn falling_particles_reach_their_terminal_speed() {
    let weight = MASS * 9.81;
    for (parameter, coefficient, speed) in [(6.0, weight / 0.5, 0.5), (7.0, weight / 4.0, 2.0)] {
        let (mut bench, source) = source(ParticleFlags::empty(), &[1.0, parameter, coefficient]);
        emit(&mut bench, source, [0.0, 0.0, 50.0], [0.0; 3]);
        bench.run(60);
        near(only(&bench, source).velocity[2], -speed, 1e-6 * speed);
    }
}

/// Without gravity: v = v0 exp(-c t / m), and v = v0 / (1 + c v0 t / m).
#[test]
fn drag_slows_down_as_its_law_says() {
    for (parameter, speed) in [(6.0, (-1.0f64).exp()), (7.0, 0.5)] {
        let flags = ParticleFlags::IGNORES_GRAVITY;
        let (mut bench, source) = source(flags, &[1.0, parameter, MASS]);
        emit(&mut bench, source, [0.0; 3], [1.0, 0.0, 0.0]);
        bench.run(20);
        near(only(&bench, source).velocity[0], speed, 4e-3);
    }
}

#[test]
fn the_strongest_drag_only_stops() {
    let (mut bench, source) = source(ParticleFlags::empty(), &[2.0, 6.0, 1e9, 7.0, 1e9]);
    emit(&mut bench, source, [0.0, 0.0, 1.0], [5.0, 0.0, 0.0]);
    bench.run(1);
    near(only(&bench, source).velocity[0], 0.0, 1e-6);
    near(only(&bench, source).position[0], 0.0, 1e-6);
}

/// Water is below height 0: it bears and slows down; above it there is air.
#[test]
fn particles_in_water() {
    let parameters = [2.0, 6.0, MASS, 8.0, 0.0];
    let (mut bench, source) = source(ParticleFlags::WATER, &parameters);
    emit(&mut bench, source, [0.0, 0.0, -5.0], [1.0, 0.0, 0.0]);
    emit(&mut bench, source, [0.0, 0.0, 20.0], [1.0, 0.0, 0.0]);
    bench.run(20);
    let [below, above] = all(&bench, source)[..] else {
        panic!("two particles");
    };
    near(below.position[2], -5.0, 1e-9);
    near(below.velocity[0], (-1.0f64).exp(), 4e-3);
    near(20.0 - above.position[2], 4.929_525_2, 1e-5);
    near(above.velocity[0], 1.0, 1e-12);
}

/// How high a particle rises again that falls from 0.5 m; metres.
fn height_of_bounce(own: f64, of_floor: f64) -> f64 {
    let (mut bench, source) = source(RESPONDABLE, &[1.0, 1.0, own]);
    floor_of(&mut bench, 1.0, of_floor);
    emit(&mut bench, source, [0.0, 0.0, 0.505], [0.0; 3]);
    bench.run(7);
    let mut highest: f64 = 0.0;
    for _ in 0..8 {
        bench.run(1);
        highest = highest.max(only(&bench, source).position[2] - 0.005);
    }
    highest
}

/// The height is looked at every 0.05 s: at most 3 mm from the top.
#[test]
fn particles_bounce_to_the_square_of_the_restitution() {
    near(height_of_bounce(0.8, 1.0), 0.32, 0.004);
    near(height_of_bounce(1.0, 1.0), 0.5, 0.004);
    near(height_of_bounce(0.7, 0.7), 0.12, 0.004);
    near(height_of_bounce(1.0, 0.0), 0.0, 1e-5);
}

/// A particle that bounces for ten seconds without loss is as high as ever.
#[test]
fn bounces_do_not_add_up_errors() {
    let (mut bench, source) = source(RESPONDABLE, &[1.0, 1.0, 1.0]);
    floor_of(&mut bench, 1.0, 1.0);
    emit(&mut bench, source, [0.0, 0.0, 0.505], [0.0; 3]);
    bench.run(200);
    let mut highest: f64 = 0.0;
    for _ in 0..14 {
        bench.run(1);
        highest = highest.max(only(&bench, source).position[2] - 0.005);
    }
    near(highest, 0.5, 0.02);
}

/// On a plane with friction mu: a = g (sin - mu cos). The slope is gravity that pulls along x as well.
#[test]
fn particles_slide_down_a_slope() {
    for (friction, acceleration) in [(0.3, 4.0 - 0.3 * 9.81), (0.0, 4.0), (0.5, 0.0)] {
        let (mut bench, source) = source(RESPONDABLE, &[1.0, 0.0, friction]);
        bench
            .scene
            .modify_settings(|settings| settings.dynamics.gravity = [4.0, 0.0, -9.81]);
        floor_of(&mut bench, 1.0, 0.0);
        emit(&mut bench, source, [0.0, 0.0, 0.005], [0.0; 3]);
        bench.run(20);
        let particle = only(&bench, source);
        near(
            particle.position[0],
            acceleration / 2.0,
            0.012 * acceleration + 1e-4,
        );
        near(particle.position[2], 0.005, 1e-4);
    }
}

/// What slides on a plane stops after v² / (2 mu g).
#[test]
fn friction_stops_a_particle() {
    let (mut bench, source) = source(RESPONDABLE, &[1.0, 0.0, 0.4]);
    floor_of(&mut bench, 1.0, 0.0);
    emit(&mut bench, source, [0.0, 0.0, 0.005], [1.0, 0.0, 0.0]);
    bench.run(20);
    let particle = only(&bench, source);
    near(particle.position[0], 1.0 / (2.0 * 0.4 * 9.81), 0.004);
    near(particle.velocity[0], 0.0, 1e-9);
}

#[test]
fn masks_say_what_particles_hit() {
    for (flags, mask, stays) in [
        (ParticleFlags::RESPONDABLE_1_TO_4, 0x0f00, true),
        (ParticleFlags::RESPONDABLE_1_TO_4, 0xf0ff, false),
        (ParticleFlags::RESPONDABLE_5_TO_8, 0x8000, true),
        (ParticleFlags::empty(), 0xffff, false),
    ] {
        let (mut bench, source) = source(flags, &[]);
        let floor = bench.floor();
        bench.change(floor, |shape| {
            shape.dynamics.respondable_mask = scene::shape::RespondableMask(mask);
        });
        emit(&mut bench, source, [0.0, 0.0, 0.1], [0.0; 3]);
        bench.run(20);
        assert_eq!(only(&bench, source).position[2] > 0.0, stays, "{mask:x}");
    }
}

/// At a hundred metres per second, half a metre in a sub-step.
#[test]
fn fast_particles_pass_no_wall() {
    let (mut bench, source) = source(RESPONDABLE | ParticleFlags::IGNORES_GRAVITY, &[]);
    bench.shape([0.01, 2.0, 2.0], [1.0, 0.0, 0.0], 1.0, false, true);
    for y in [-0.9, 0.0, 0.7] {
        emit(&mut bench, source, [0.0, y, 0.0], [100.0, 3.0, 1.0]);
    }
    bench.run(4);
    for particle in all(&bench, source) {
        near(particle.position[0], 0.995 - 0.005, 1e-4);
    }
}

/// A jet of n particles a second at speed v on a body that stops them pushes with n m v.
#[test]
fn a_jet_pushes_a_body() {
    let (mut bench, source) = source(RESPONDABLE | ParticleFlags::IGNORES_GRAVITY, &[]);
    bench.gravity(0.0);
    let body = bench.shape([0.1, 1.0, 1.0], [0.55, 0.0, 0.0], 10.0, true, true);
    for _ in 0..20 {
        for number in 0..10 {
            let place = [0.0, 0.01 * f64::from(number), 0.0];
            emit(&mut bench, source, place, [5.0, 0.0, 0.0]);
        }
        bench.run(1);
    }
    bench.run(20);
    let momentum = 10.0 * bench.shape_of(body).velocity.linear[0];
    let expected = 200.0 * MASS * (5.0 - bench.shape_of(body).velocity.linear[0]);
    near(momentum, expected, 0.01 * expected);
}

/// Momentum is exchanged, not made: a particle that bounces off a free body without loss.
#[test]
fn a_body_takes_the_momentum_of_a_bounce() {
    let (mut bench, source) = source(RESPONDABLE, &[1.0, 1.0, 1.0]);
    bench.gravity(0.0);
    let body = bench.shape([0.1; 3], [0.5, 0.0, 0.0], 2.0 * MASS, true, true);
    bench.change(body, |shape: &mut Shape| shape.material.restitution = 1.0);
    emit(&mut bench, source, [0.0; 3], [3.0, 0.0, 0.0]);
    bench.run(20);
    // One to two: the particle comes back with a third of its speed, the body has two thirds of it.
    near(only(&bench, source).velocity[0], -1.0, 1e-9);
    near(bench.shape_of(body).velocity.linear[0], 2.0, 1e-9);
}

#[test]
fn particles_of_an_object_collide_if_they_may() {
    for (flags, speeds) in [
        (ParticleFlags::PARTICLE_RESPONDABLE, [0.0, 2.0]),
        (ParticleFlags::empty(), [2.0, 0.0]),
    ] {
        let flags = flags | ParticleFlags::IGNORES_GRAVITY;
        let (mut bench, source) = source(flags, &[1.0, 1.0, 1.0]);
        emit(&mut bench, source, [0.0; 3], [2.0, 0.0, 0.0]);
        emit(&mut bench, source, [0.2, 0.0, 0.0], [0.0; 3]);
        bench.run(10);
        let found: Vec<f64> = all(&bench, source).iter().map(|p| p.velocity[0]).collect();
        near(found[0], speeds[0], 1e-9);
        near(found[1], speeds[1], 1e-9);
    }
}

/// A fountain over a body that can be pushed, and where all is after a second.
fn fountain(threads: usize, is_unseen: bool) -> (Bench, i64, Handle) {
    let (mut bench, source) = source(RESPONDABLE, &[2.0, 0.0, 0.5, 1.0, 0.5]);
    bench.dynamics = Dynamics::new(threads.try_into().expect("not none"), FormMaker::default());
    bench.dynamics.set_unseen(is_unseen);
    floor_of(&mut bench, 0.8, 0.7);
    let body = bench.shape([0.1, 0.1, 0.1], [0.3, 0.0, 0.05], 0.005, true, true);
    for step in 0..20 {
        for number in 0..5 {
            let turn = f64::from(step * 5 + number);
            let velocity = [2.0 + 0.1 * turn.sin(), 0.1 * turn.cos(), 0.3];
            emit(&mut bench, source, [0.0, 0.0, 0.1], velocity);
        }
        bench.run(1);
    }
    (bench, source, body)
}

#[test]
fn the_same_particles_go_the_same_ways() {
    let [one, four] = [1, 4].map(|threads| fountain(threads, false));
    let bits = |(bench, source, body): &(Bench, i64, Handle)| {
        let particles = all(bench, *source).into_iter();
        let numbers = particles.flat_map(|p| [p.position, p.velocity]).flatten();
        let numbers = numbers.chain(bench.at(*body));
        numbers.map(f64::to_bits).collect::<Vec<_>>()
    };
    assert_eq!(bits(&one), bits(&four));
    assert!(one.0.at(one.2)[0] > 0.3005, "the body was pushed");
}

/// What scripts can read is the same whether somebody looks or not: bodies that are pushed.
#[test]
fn nobody_has_to_look() {
    let [seen, unseen] = [false, true].map(|is_unseen| fountain(1, is_unseen));
    assert_eq!(seen.0.at(seen.2), unseen.0.at(unseen.2));
    // Without anything to push, those that only pages show stay where they were emitted.
    for (flags, moves) in [
        (RESPONDABLE, false),
        (ParticleFlags::PAINT_TAG, true),
        (ParticleFlags::PAINT_TAG | ParticleFlags::INVISIBLE, false),
    ] {
        let (mut bench, source) = source(flags, &[]);
        bench.dynamics.set_unseen(true);
        bench.floor();
        emit(&mut bench, source, [0.0, 0.0, 1.0], [0.0; 3]);
        bench.run(1);
        assert_eq!(only(&bench, source).position[2] < 1.0, moves, "{flags:?}");
    }
}

/// Nor do particles whose numbers are beyond all measure stop a body.
#[test]
fn bodies_survive_what_particles_cannot_be() {
    let (mut bench, source) = source(RESPONDABLE, &[1.0, 1.0, 1.0]);
    bench.gravity(0.0);
    let body = bench.shape([0.1; 3], [0.0, 0.0, 0.0], 1.0, true, true);
    for speed in [1e200, 1e300, -1e308, f64::MAX] {
        emit(&mut bench, source, [0.01, 0.0, 0.0], [speed, speed, 0.0]);
        bench.run(2);
    }
    assert_eq!(all(&bench, source), []);
    assert!(bench.at(body).iter().all(|x| x.is_finite()));
    assert!(bench.dynamics.take_frozen().is_empty());
}

#[test]
fn what_leaves_the_world_is_gone() {
    let (mut bench, source) = source(RESPONDABLE, &[]);
    emit(&mut bench, source, [0.0, 0.0, 999.9], [0.0, 0.0, 50.0]);
    emit(&mut bench, source, [1e200, 0.0, 0.0], [1e300, 0.0, 0.0]);
    emit(&mut bench, source, [0.0, 0.0, 1.0], [0.0; 3]);
    bench.run(1);
    near(only(&bench, source).position[2], 1.0, 0.02);
}
