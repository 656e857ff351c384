//! Any bytes as a file of the cache, and as the result in one: convex pieces that are written again as they were read, and that parry takes or refuses, or nothing.
//!
//! The last byte says what the others are. Bit 0: a file, or hulls. Bit 1: whether numbers of eight bytes are made of single ones, so that points lie near each other.
//!
//! `cargo fuzz run kept_pieces`
#![no_main]
// Both are private to their crates.
#![allow(dead_code)]

use libfuzzer_sys::fuzz_target;
use parry3d_f64::math::Vector;
use parry3d_f64::shape::ConvexPolyhedron;

#[path = "../../crates/file-cache/src/entry.rs"]
mod entry;
#[path = "../../crates/file-cache/src/key.rs"]
mod key;
#[path = "../../crates/dynamics/src/bodies/kept_hulls.rs"]
mod kept_hulls;

use kept_hulls::{Hull, decode, encode};
use key::Key;

fn read_file(bytes: &[u8]) {
    let key = Key::of(&[b"a result"]);
    if let Some(result) = entry::open(&key, bytes.to_vec()) {
        assert_eq!(entry::seal(&key, &result), bytes);
    }
    let sealed = entry::seal(&key, bytes);
    assert_eq!(entry::open(&key, sealed.clone()).as_deref(), Some(bytes));
    assert!(entry::open(&Key::of(&[b"another"]), sealed).is_none());
}

fn read_hulls(bytes: &[u8]) {
    let Some(hulls) = decode(bytes) else { return };
    assert_eq!(encode(&hulls), bytes);
    for hull in hulls {
        let points = hull.points.iter().map(|&[x, y, z]| Vector::new(x, y, z)).collect();
        let _ = ConvexPolyhedron::from_convex_mesh(points, &hull.triangles);
    }
}

/// A hull with few points on a grid: the first byte says how many.
fn small(bytes: &[u8]) -> Option<Hull> {
    let (count, rest) = bytes.split_first()?;
    let (points, corners) = rest.split_at_checked(3 * usize::from(count % 16))?;
    let three = |bytes: &[u8]| [bytes[0], bytes[1], bytes[2]];
    Some(Hull {
        points: points.chunks_exact(3).map(|point| three(point).map(f64::from)).collect(),
        triangles: corners.chunks_exact(3).map(|corners| three(corners).map(u32::from)).collect(),
    })
}

fuzz_target!(|bytes: &[u8]| {
    let Some((kind, bytes)) = bytes.split_last() else { return };
    match (kind & 1, kind & 2) {
        (0, _) => read_file(bytes),
        (_, 0) => read_hulls(bytes),
        _ => small(bytes).into_iter().for_each(|hull| read_hulls(&encode(&[hull]))),
    }
});
