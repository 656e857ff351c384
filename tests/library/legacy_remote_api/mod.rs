//! Programs with `simxStart`: what they send, and what they receive (spec: legacy-remote-api).
#![allow(clippy::disallowed_methods, reason = "every wait of a test is bounded by the clock")]

#[path = "../support/mod.rs"]
mod support;

mod commands;
mod files;
mod modes;
mod services;
mod synchronous;
mod transcripts;
