//! What nobody should do: each ends with an error or a result, in bounded time and memory.

mod debug;
mod input;
mod messages;
mod physics;
