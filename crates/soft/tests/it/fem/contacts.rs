//! Cloths on obstacles and on themselves.

use soft::fem::{Contact, Deformable, Material, Surface, nearby};
use soft::{Touch, V3};

use super::{hold_at_rest, run_in_contact, sheet};
use crate::{GRAVITY, near};

/// Contacts of all nodes with a sphere.
pub(super) fn on_sphere(
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
        let contacts = on_sphere(&parts[0], V3::zeros(), 0.1, obstacle, 0.5);
        run_in_contact(&mut parts, &mut kept, contacts);
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
        let contacts = nearby(&parts, &[], 1e-3, 0.005, |_, _| Some(0.3));
        run_in_contact(&mut parts, &mut kept, contacts);
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
