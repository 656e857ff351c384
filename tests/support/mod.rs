//! Shared by the integration tests.
#![allow(dead_code, reason = "each test uses a part")]
#![allow(clippy::disallowed_methods, reason = "every wait of a test is bounded by the clock")]

pub mod compare;
pub mod process;
