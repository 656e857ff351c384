//! Particles that collide with each other.

use std::collections::BTreeMap;

use rapier3d_f64::math::Vector;

use super::flight::Touch;
use super::{Particle, from_vector, to_vector};

/// No cell has a higher number.
const FARTHEST: f64 = 1e15;

/// Cells as wide as the largest particle, with the numbers of those in them.
type Grid = BTreeMap<[i64; 3], Vec<usize>>;

/// Moves overlapping particles apart, and lets those that approach exchange momentum.
pub(super) fn collide(items: &mut [Particle], touch: Touch) {
    let width = items.iter().map(|item| item.size).fold(0.0, f64::max);
    let mut grid = Grid::new();
    for (number, item) in items.iter().enumerate() {
        grid.entry(cell(item, width)).or_default().push(number);
    }
    for first in 0..items.len() {
        for second in neighbours(&grid, cell(&items[first], width), first) {
            if let Ok([first, second]) = items.get_disjoint_mut([first, second]) {
                meet(first, second, touch.restitution * touch.restitution);
            }
        }
    }
}

fn cell(item: &Particle, width: f64) -> [i64; 3] {
    let number = |x: f64| scene::numbers::truncated((x / width).floor().clamp(-FARTHEST, FARTHEST));
    item.position.map(number)
}

/// Those after a particle in its cell and in those around it, in their order.
fn neighbours(grid: &Grid, [x, y, z]: [i64; 3], first: usize) -> Vec<usize> {
    let mut found = Vec::new();
    for i in x - 1..=x + 1 {
        for j in y - 1..=y + 1 {
            for cell in grid
                .range([i, j, z - 1]..=[i, j, z + 1])
                .map(|(_, cell)| cell)
            {
                found.extend(cell.iter().filter(|second| **second > first));
            }
        }
    }
    found.sort_unstable();
    found
}

fn meet(first: &mut Particle, second: &mut Particle, restitution: f64) {
    let apart = to_vector(second.position) - to_vector(first.position);
    let (distance, reach) = (apart.length(), f64::midpoint(first.size, second.size));
    if distance >= reach || distance < 1e-12 {
        return;
    }
    let normal = apart / distance;
    let part = second.mass / (first.mass + second.mass);
    let approach = (to_vector(first.velocity) - to_vector(second.velocity)).dot(normal);
    let change = normal * (approach.max(0.0) * (1.0 + restitution));
    let shift = normal * (reach - distance);
    let move_by = |item: &mut Particle, part: f64| {
        let add = |to: [f64; 3], by: Vector| from_vector(to_vector(to) - by * part);
        item.velocity = add(item.velocity, change);
        item.position = add(item.position, shift);
    };
    move_by(first, part);
    move_by(second, part - 1.0);
}
