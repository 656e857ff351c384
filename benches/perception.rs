//! What sensors ask for: rays, volumes, distances and collisions; of this simulator's crates and of parry alone.
//!
//! `cargo bench --bench perception`

#[path = "../crates/proximity/benches/rows/mod.rs"]
mod queries;

criterion::criterion_main!(queries::group);
