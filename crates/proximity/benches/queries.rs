//! Rays, volumes, distances and collisions, of this crate and of parry alone. The same rows are in `benches/perception.rs` of the simulator.
//!
//! `cargo bench -p swanilda-proximity`

mod rows;

criterion::criterion_main!(rows::group);
