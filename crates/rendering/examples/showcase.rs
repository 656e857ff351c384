//! Writes a picture of the scene that tests use, as a portable pixmap: `cargo run -p swanilda-rendering --example showcase picture.ppm`.

#[path = "../tests/common/mod.rs"]
mod common;

use std::io::Write;

use common::showcase::{Showcase, camera, lights};
use rendering::{Channels, Renderer};

fn main() -> std::io::Result<()> {
    let path = std::env::args().nth(1).unwrap_or("showcase.ppm".to_owned());
    let shadows = std::env::args().nth(2).is_some();
    let showcase = Showcase::new();
    let (instances, points, lines, lights) = (
        showcase.instances(),
        showcase.points(),
        showcase.lines(),
        lights(),
    );
    let world = rendering::World {
        shadows,
        ..showcase.world(&instances, &points, &lines, &lights)
    };
    let picture = Renderer::new(2).render(&world, &camera(960, 640), Channels::ALL);
    let mut file = std::fs::File::create(path)?;
    writeln!(file, "P6 960 640 255")?;
    picture
        .colour
        .chunks(3 * 960)
        .rev()
        .try_for_each(|row| file.write_all(row))
}
