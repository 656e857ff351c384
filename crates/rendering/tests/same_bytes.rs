//! The same bytes on every machine, with any number of threads, whatever was drawn before.

mod common;

use common::showcase::{self, Showcase};
use rendering::{Channels, Picture, Renderer, World};

fn showcase_picture(threads: usize, width: u32, height: u32, channels: Channels) -> Picture {
    let showcase = Showcase::new();
    let (instances, points, lines, lights) = (
        showcase.instances(),
        showcase.points(),
        showcase.lines(),
        showcase::lights(),
    );
    let world = World {
        shadows: true,
        ..showcase.world(&instances, &points, &lines, &lights)
    };
    Renderer::new(threads).render(&world, &showcase::camera(width, height), channels)
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let one = showcase_picture(1, 203, 131, Channels::ALL);
    for threads in [2, 3, 7] {
        assert!(
            one == showcase_picture(threads, 203, 131, Channels::ALL),
            "{threads}"
        );
    }
}

#[test]
fn channels_do_not_depend_on_each_other() {
    let all = showcase_picture(1, 120, 90, Channels::ALL);
    assert!(all.colour == showcase_picture(1, 120, 90, Channels::COLOUR).colour);
    assert!(all.depth == showcase_picture(1, 120, 90, Channels::DEPTH).depth);
    assert!(all.ids == showcase_picture(1, 120, 90, Channels::IDS).ids);
}

#[test]
fn a_renderer_remembers_nothing() {
    let showcase = Showcase::new();
    let (instances, lights) = (showcase.instances(), showcase::lights());
    let world = showcase.world(&instances, &[], &[], &lights);
    let (camera, other) = (showcase::camera(64, 64), showcase::camera(200, 30));
    let mut renderer = Renderer::new(2);
    let first = renderer.render(&world, &camera, Channels::ALL);
    renderer.render(&World::EMPTY, &other, Channels::ALL);
    renderer.render(&world, &other, Channels::DEPTH);
    assert!(renderer.render(&world, &camera, Channels::ALL) == first);
}

/// The FNV-1a hash of bytes (G. Fowler, L. Noll and P. Vo).
fn hash(bytes: impl Iterator<Item = u8>) -> u64 {
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// These numbers must be the same on every machine. They change when the look of pictures changes: look at `--example showcase` then.
#[test]
fn pictures_have_the_same_bytes_on_every_machine() {
    let picture = showcase_picture(2, 160, 120, Channels::ALL);
    let depth = picture
        .depth
        .iter()
        .flat_map(|depth| depth.to_bits().to_le_bytes());
    let ids = picture.ids.iter().flat_map(|id| id.to_le_bytes());
    let hashes = [hash(picture.colour.iter().copied()), hash(depth), hash(ids)];
    assert_eq!(
        hashes,
        [
            5361313973938338503,
            8218506368581337171,
            18123009579411283979
        ]
    );
}
