//! The chunks of a file as types, one struct per stream of the format's appendix A.
//!
//! A field is `None` where its chunk is missing: what that means is the business of whoever puts a scene together. Numbers after
//! `bit` count from the least significant one.

mod cloud;
mod graph;
mod legacy;
mod mechanics;
mod object;
mod path;
mod scene;
mod script;
mod sensor;
mod shape;

pub use cloud::*;
pub use graph::*;
pub use legacy::*;
pub use mechanics::*;
pub use object::*;
pub use path::*;
pub use scene::*;
pub use script::*;
pub use sensor::*;
pub use shape::*;
