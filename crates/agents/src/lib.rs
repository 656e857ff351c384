//! Tools by which language models work with a simulator, by the Model Context Protocol.
//!
//! [`Agent`] is the [`Service`](mcp::Service): a simulator, and what was seen and kept of it. Each file below `tools` is one group of
//! tools: their descriptions with the schemas of their arguments, and what they do. What is easier in Lua is in `helper.lua`, which
//! lives in the sandbox. Answers are short texts for a model to read; what a program would want of them is there as JSON too.

mod agent;
mod arguments;
mod clock;
mod console;
mod resources;
mod tools;
mod values;

pub use agent::{Agent, Setting};
