//! Programs with `simxStart`: what they send, and what they receive (spec: legacy-remote-api).
#![allow(
    clippy::disallowed_methods,
    reason = "every wait of a test is bounded by the clock"
)]

mod bad_messages;
mod commands;
mod files;
mod modes;
mod services;
mod simx;
mod synchronous;
mod transcripts;
