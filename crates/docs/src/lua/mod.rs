//! What is read from Lua: the comments of the library, and the words of scripts.

pub mod comments;
pub mod tokens;
