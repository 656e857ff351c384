//! The points at which ropes, cloths and volumes may touch an obstacle.

use rapier3d_f64::parry::bounding_volume::{Aabb, BoundingVolume};
use soft::fem::{self, Deformable, Spot};
use soft::{Contact, Rod, Surface, Touch, V3};

use super::obstacle::{Near, Obstacle, Search, place};

/// An edge or triangle is nearer than its corners where it is so by this part of the radius: less would come and go as what lies there gives way.
const NEARER: f64 = 1e-3;

/// The points of a rope: nodes, and edges where they are nearer than their ends.
pub(super) fn of_rod(
    rod: &Rod,
    search: &Search,
    obstacle: &Obstacle,
    mut nodes: Vec<Option<Near>>,
) -> Vec<Contact> {
    let (mut contacts, mut taken) = (Vec::new(), Vec::new());
    for edge in 0..rod.len() - 1 {
        let ends = [edge, edge + 1];
        let places = ends.map(|node| rod.point(node));
        let is_exempt = ends.iter().any(|node| search.is_exempt(*node, obstacle));
        let around = Aabb::from_points(places.map(place));
        if rod.is_broken(edge) || is_exempt || !around.intersects(&obstacle.bounds) {
            continue;
        }
        let reach = nearer(&nodes, &ends, obstacle.reach, rod.material.radius);
        if let Some((weight, near)) = obstacle.nearest_on_edge(places, reach) {
            contacts.push(on_rod(search, obstacle, (edge, weight), &near, true));
            let length = (places[1] - places[0]).norm();
            let ways = [weight, 1.0 - weight].map(|part| part * length);
            taken.extend(beside(&ends, &ways, rod.material.radius));
        }
    }
    taken.into_iter().for_each(|node| nodes[node] = None);
    for (node, near) in touching(&nodes, obstacle) {
        let edge = node.min(rod.len() - 2);
        let weight = (node - edge) as f64;
        contacts.push(on_rod(search, obstacle, (edge, weight), near, false));
    }
    contacts
}

/// How near an edge or triangle has to be to be nearer than its corners.
fn nearer(nodes: &[Option<Near>], corners: &[usize], reach: f64, radius: f64) -> f64 {
    let known = corners.iter().filter_map(|corner| nodes[*corner].as_ref());
    known.map(|near| near.distance).fold(reach, f64::min) - NEARER * radius
}

/// The corners that a contact on their edge or triangle stands for, by their distances from it: two for the same place would take turns.
fn beside<'a>(
    corners: &'a [usize],
    ways: &'a [f64],
    radius: f64,
) -> impl Iterator<Item = usize> + 'a {
    let known = corners.iter().zip(ways);
    let near = known.filter(move |(_, way)| **way < radius);
    near.map(|(corner, _)| *corner)
}

fn touching<'a>(
    nodes: &'a [Option<Near>],
    obstacle: &Obstacle,
) -> impl Iterator<Item = (usize, &'a Near)> {
    let reach = obstacle.reach;
    let known = nodes.iter().enumerate();
    let known = known.filter_map(|(node, near)| Some((node, near.as_ref()?)));
    known.filter(move |(_, near)| near.distance < reach)
}

fn touch_at(near: &Near, obstacle: &Obstacle) -> Touch {
    Touch::new(near.point, near.normal, obstacle.friction)
}

fn on_rod(
    search: &Search,
    obstacle: &Obstacle,
    (edge, weight): (usize, f64),
    near: &Near,
    is_between: bool,
) -> Contact {
    let last = u64::from(weight == 1.0) << 1;
    Contact {
        rod: search.number,
        edge,
        weight,
        surface: Surface::Obstacle(obstacle.velocity_at(near.point, search.start.step)),
        touch: touch_at(near, obstacle),
        key: key(obstacle) | last | u64::from(is_between),
    }
}

/// The points of a cloth or volume: nodes, and triangles where they are nearer than their corners.
pub(super) fn of_deformable(
    part: &Deformable,
    search: &Search,
    obstacle: &Obstacle,
    mut nodes: Vec<Option<Near>>,
) -> Vec<fem::Contact> {
    let (mut contacts, mut taken) = (Vec::new(), Vec::new());
    for (number, corners) in part.surface().iter().enumerate() {
        let places = corners.map(|node| part.points()[node]);
        let is_exempt = corners.iter().any(|node| search.is_exempt(*node, obstacle));
        let around = Aabb::from_points(places.map(place));
        if part.is_torn(number) || is_exempt || !around.intersects(&obstacle.bounds) {
            continue;
        }
        let reach = nearer(&nodes, corners, obstacle.reach, part.material().radius);
        if let Some((weights, near)) = obstacle.nearest_on_triangle(places, reach) {
            let spot = [0, 1, 2].map(|corner| (corners[corner], weights[corner]));
            contacts.push(on_part(search, obstacle, spot, &near, number << 1 | 1));
            let at = (0..3).fold(V3::zeros(), |sum, i| sum + places[i] * weights[i]);
            let ways = places.map(|place| (place - at).norm());
            taken.extend(beside(corners, &ways, part.material().radius));
        }
    }
    taken.into_iter().for_each(|node| nodes[node] = None);
    for (node, near) in touching(&nodes, obstacle).filter(|(node, _)| part.is_on_surface(*node)) {
        let spot = [(node, 1.0), (node, 0.0), (node, 0.0)];
        contacts.push(on_part(search, obstacle, spot, near, node << 1));
    }
    contacts
}

fn on_part(
    search: &Search,
    obstacle: &Obstacle,
    spot: Spot,
    near: &Near,
    element: usize,
) -> fem::Contact {
    fem::Contact {
        part: search.number,
        spot,
        surface: fem::Surface::Obstacle(obstacle.velocity_at(near.point, search.start.step)),
        touch: touch_at(near, obstacle),
        key: key(obstacle) | element as u64,
    }
}

/// What keys of contacts with an obstacle begin with.
fn key(obstacle: &Obstacle) -> u64 {
    u64::from(obstacle.handle.into_raw_parts().0) << 32
}

/// The index of the collider that a contact with a rigid body or an obstacle is with, by its key.
pub(super) fn collider_of(key: u64) -> u32 {
    (key >> 32) as u32
}
