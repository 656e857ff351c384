//! Shared by the integration tests.
#![allow(dead_code, reason = "each test uses a part")]

pub mod compare;
pub mod process;
