//! Rods on cloths.

use nalgebra::Vector6;
use soft::fem::{Deformable, Material, nearby};
use soft::{Body, Hold, Rod, SoftSystem, Target, V3, between, solve_system};

use super::{hold_at_rest, sheet};
use crate::{GRAVITY, line, near, rope, step};

/// A cloth that is held at its border, 20 cm wide, of 0.2 kg/m2.
fn trampoline() -> Deformable {
    let (points, triangles) = sheet([0.2, 0.2], [8, 8]);
    let material = Material {
        radius: 0.001,
        stretch: 2000.0,
        bend: 1e-5,
        damping: 0.01,
        ..Material::solid(0.0, 0.3)
    };
    let mut cloth =
        Deformable::cloth(&points, &triangles, true, 0.2, material).expect("it is a mesh");
    hold_at_rest(&mut cloth, |place| {
        [place.x, place.y]
            .iter()
            .any(|x| *x < 1e-9 || *x > 0.2 - 1e-9)
    });
    cloth
}

/// A rod of 20 g and 10 cm, 3 mm above the middle of the cloth.
fn rod_above() -> Rod {
    let material = soft::Material {
        line_density: 0.2,
        bend: 1e-3,
        twist: 1e-3,
        damping: 0.01,
        ..rope()
    };
    let points = line(
        V3::new(0.052, 0.098, 0.006),
        V3::new(0.152, 0.105, 0.006),
        10,
    );
    Rod::new(&points, None, true, material).expect("it is a line")
}

struct World {
    rods: Vec<Rod>,
    parts: Vec<Deformable>,
    bodies: Vec<Body>,
    rod_contacts: Vec<soft::Contact>,
    contacts: Vec<soft::fem::Contact>,
}

impl World {
    fn new(rods: Vec<Rod>, parts: Vec<Deformable>) -> Self {
        Self {
            rods,
            parts,
            bodies: Vec::new(),
            rod_contacts: Vec::new(),
            contacts: Vec::new(),
        }
    }

    /// One step; the impulses on bodies.
    fn step(&mut self) -> Vec<Vector6<f64>> {
        let mut contacts = nearby(&self.parts, &self.rods, 1e-3, 0.005, |a, b| {
            (a != b).then_some(0.4)
        });
        soft::fem::Contact::carry_on(&mut contacts, &mut self.contacts);
        self.contacts = contacts;
        let mut rod_contacts = between(&self.rods, 2e-3, |a, b| (a != b).then_some(0.4));
        soft::Contact::carry_on(&mut rod_contacts, &mut self.rod_contacts);
        self.rod_contacts = rod_contacts;
        let all = SoftSystem {
            rods: &mut self.rods,
            rod_contacts: &mut self.rod_contacts,
            parts: &mut self.parts,
            contacts: &mut self.contacts,
        };
        solve_system(all, &mut self.bodies, step(0.005))
    }

    /// The force on what holds the cloth, upwards, newtons.
    fn held_force(&self) -> f64 {
        self.parts[0].holds.iter().map(|hold| hold.force.z).sum()
    }
}

#[test]
fn a_rod_lies_on_a_cloth_which_bears_its_weight() {
    let mut world = World::new(vec![rod_above()], vec![trampoline()]);
    (0..400).for_each(|_| drop(world.step()));
    let masses: f64 = (0..11).map(|node| world.rods[0].mass(node)).sum();
    near(
        world.held_force(),
        (masses + 0.2 * 0.2 * 0.2) * GRAVITY,
        1e-3,
    );
    let lowest = world.parts[0]
        .points()
        .iter()
        .map(|point| point.z)
        .fold(0.0, f64::min);
    assert!(lowest < -1e-3, "{lowest}");
    // Nowhere through it, and at rest.
    for node in 0..11 {
        let place = world.rods[0].point(node);
        assert!(place.z > lowest + 0.0025, "{node} {place}");
        assert!(world.rods[0].velocity(node).norm() < 1e-4);
    }
}

#[test]
fn rods_on_a_rod_on_a_cloth_are_borne_as_well() {
    let mut upper = rod_above();
    let across = line(V3::new(0.1, 0.05, 0.012), V3::new(0.101, 0.15, 0.012), 10);
    upper.set_motion(&across, &vec![V3::zeros(); 11]);
    let far = {
        let mut far = rod_above();
        let points = line(V3::new(1.0, 0.0, 1.0), V3::new(1.1, 0.0, 1.0), 10);
        far.set_motion(&points, &vec![V3::zeros(); 11]);
        far
    };
    // The one that touches nothing stands between the others: their numbers come back as they were.
    let mut world = World::new(vec![upper, far, rod_above()], vec![trampoline()]);
    (0..20).for_each(|_| drop(world.step()));
    near(world.rods[1].velocity(3).z, -GRAVITY * 0.1, 0.03);
    (0..400).for_each(|_| drop(world.step()));
    let masses: f64 = (0..11).map(|node| world.rods[0].mass(node)).sum();
    near(
        world.held_force(),
        (2.0 * masses + 0.2 * 0.2 * 0.2) * GRAVITY,
        2e-2,
    );
    let [upper, lower] = [0, 2].map(|rod| world.rods[rod].point(5).z);
    assert!(upper - lower > 0.0039, "{upper} {lower}");
}

#[test]
fn a_body_that_pulls_a_rod_across_a_cloth_feels_friction() {
    let mut rod = rod_above();
    let body = Body::new(
        rod.point(0),
        Vector6::zeros(),
        nalgebra::Matrix6::identity() * 1e-4,
    );
    let direction = rod.direction(0);
    rod.holds
        .push(Hold::new(0, Target::Body(0, V3::zeros()), Some(direction)));
    let mut world = World::new(vec![rod], vec![trampoline()]);
    world.bodies.push(body);
    let mut drag = 0.0;
    for number in 0..400 {
        world.bodies[0].com = world.rods[0].point(0);
        let speed = if number < 200 { 0.0 } else { 0.02 };
        // So heavy that nothing changes its velocity.
        world.bodies[0].velocity = Vector6::new(-speed, 0.0, 0.0, 0.0, 0.0, 0.0);
        world.bodies[0].response = nalgebra::Matrix6::identity() * 1e-9;
        let impulses = world.step();
        if number >= 350 {
            drag += impulses[0].x / 0.005 / 50.0;
        }
    }
    let touching = world
        .contacts
        .iter()
        .filter(|contact| contact.touch.impulse.norm() > 1e-7);
    let (mut along, mut ratios) = (0.0, Vec::new());
    for contact in touching {
        let (impulse, normal) = (contact.touch.impulse, contact.touch.normal);
        let pressed = impulse.dot(&normal);
        ratios.push((impulse - normal * pressed).norm() / pressed);
        // Parts stand before rods.
        let sign = if contact.part == 0 { -1.0 } else { 1.0 };
        along += sign * impulse.x / 0.005;
    }
    assert!(!ratios.is_empty());
    assert!(
        ratios.iter().all(|ratio| (ratio - 0.4).abs() < 0.01),
        "{ratios:?}"
    );
    near(drag, along, 0.05);
}

#[test]
fn a_rod_with_a_cloth_has_the_same_bits_again() {
    let run = || {
        let mut world = World::new(vec![rod_above()], vec![trampoline()]);
        (0..60).for_each(|_| drop(world.step()));
        (0..11)
            .map(|node| world.rods[0].point(node))
            .collect::<Vec<V3>>()
    };
    assert_eq!(run(), run());
}
