//! Particle objects: what they keep and refuse, how long, and what is drawn of them.

use super::*;
use crate::Scene;

fn style(flags: ParticleFlags) -> ParticleStyle {
    ParticleStyle {
        kind: ParticleKind::Spheres,
        flags,
        size: 0.1,
        density: 1000.0,
        parameters: Parameters::default(),
        life_time: 0.0,
        max_items: 2,
        colour: Colour::new([1.0; 3]),
    }
}

fn object(flags: ParticleFlags) -> ParticleObject {
    ParticleObject::new(style(flags), 1)
}

/// A particle at rest at that place along x.
fn at(x: f64) -> [f64; 6] {
    [x, 0.0, 0.0, 0.0, 0.0, 0.0]
}

fn places(object: &ParticleObject) -> Vec<f64> {
    object
        .items()
        .map(|particle| particle.position[0])
        .collect()
}

#[test]
fn a_full_object_refuses_and_a_cyclic_one_replaces_the_oldest() {
    let (mut plain, mut cyclic) = (
        object(ParticleFlags::empty()),
        object(ParticleFlags::CYCLIC),
    );
    let added = [1.0, 2.0, 3.0].map(|x| plain.add(&at(x)));
    assert_eq!(
        (added, places(&plain)),
        ([true, true, false], vec![1.0, 2.0])
    );
    let added = [1.0, 2.0, 3.0].map(|x| cyclic.add(&at(x)));
    assert_eq!((added, places(&cyclic)), ([true; 3], vec![2.0, 3.0]));
    plain.clear();
    assert!(plain.add(&at(5.0)) && places(&plain) == [5.0]);
}

#[test]
fn the_mass_is_that_of_a_ball() {
    let mut plain = object(ParticleFlags::empty());
    assert!(plain.add(&at(0.0)));
    let mass = |object: &ParticleObject| object.items().next().map(|particle| particle.mass);
    let ball = |radius: f64, density: f64| density * 4.0 / 3.0 * PI * radius.powi(3);
    assert!((mass(&plain).unwrap() - ball(0.05, 1000.0)).abs() < 1e-12);
    let flags = ParticleFlags::ITEM_SIZES | ParticleFlags::ITEM_DENSITIES;
    let mut own = object(flags | ParticleFlags::ITEM_COLOURS);
    assert_eq!(own.item_len(), 11);
    assert!(own.add(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.2, 500.0, 1.0, 0.5, 0.0]));
    assert!((mass(&own).unwrap() - ball(0.1, 500.0)).abs() < 1e-12);
    assert_eq!(own.items[0].colour, Some([1.0, 0.5, 0.0]));
}

#[test]
fn what_is_no_particle_is_refused() {
    let mut object = object(ParticleFlags::ITEM_SIZES);
    assert!(!object.add(&at(0.0)) && !object.add(&[]));
    assert!(!object.add(&[0.0, 0.0, f64::NAN, 0.0, 0.0, 0.0, 1.0]));
    assert!(object.add(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0]));
    assert!(object.items[0].size > 0.0 && object.items[0].mass > 0.0);
    assert!(object.add(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1e300]));
    assert!(object.items[1].mass.is_finite());
}

#[test]
fn particles_live_their_time() {
    let mut object = ParticleObject::new(
        ParticleStyle {
            life_time: 0.5,
            max_items: 9,
            ..style(ParticleFlags::empty())
        },
        1,
    );
    assert!(object.add(&at(1.0)));
    for _ in 0..50 {
        object.age(0.005, |_| false);
    }
    assert!(object.add(&at(2.0)));
    for _ in 0..49 {
        object.age(0.005, |_| false);
    }
    assert_eq!(places(&object), [1.0, 2.0]);
    object.age(0.005, |_| false);
    assert_eq!(places(&object), [2.0]);
    object.age(0.005, |particle| particle.position[0] > 1.0);
    assert!(places(&object).is_empty());
}

/// Scripts cannot reach what is drawn of particles, and it goes with them.
#[test]
fn particles_are_drawn_where_they_are() {
    let mut scene = Scene::new();
    let drawings = scene.drawings_mut();
    let hidden = style(ParticleFlags::INVISIBLE);
    drawings.particles_mut().add(hidden, 7);
    let handle = drawings
        .particles_mut()
        .add(style(ParticleFlags::PAINT_TAG), 7);
    assert!(
        drawings
            .particles_mut()
            .get_mut(handle)
            .unwrap()
            .add(&at(3.0))
    );
    drawings.draw_particles();
    let before = drawings.last_change();
    let drawn: Vec<_> = drawings.iter().collect();
    let [(id, drawing)] = drawn[..] else {
        panic!("{drawn:?}");
    };
    assert_eq!(drawing.items().next().unwrap().points(), [[3.0, 0.0, 0.0]]);
    assert!(
        drawing
            .style
            .flags
            .contains(super::super::options::DrawingFlags::PAINT_TAG)
    );
    assert!(drawings.get(id).is_err() && drawings.remove(id).is_err());
    drawings.remove_all();
    assert_eq!(drawings.iter().count(), 1);
    // Without a change nothing is drawn again.
    let before = before.max(drawings.last_change());
    drawings.draw_particles();
    assert_eq!(drawings.last_change(), before);
    scene.forget_owner(7);
    assert!(scene.drawings().iter().next().is_none() && scene.drawings().last_change() > before);
}
