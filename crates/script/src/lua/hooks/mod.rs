//! Hooks of coroutines: pre-emption and limits, interruption by signals, and what scripts may do with `debug`.

pub(super) mod beside;
pub(super) mod count;
pub(super) mod debug_library;
pub(super) mod interrupt;
pub(super) mod listener;
pub(super) mod resume;
pub(super) mod running;
