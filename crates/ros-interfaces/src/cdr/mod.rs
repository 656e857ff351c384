//! The bytes of ROS 2: plain CDR (XCDR1), the representation that all DDS implementations have in common.
//!
//! A message begins with four bytes: the representation and two of options. Numbers are aligned to their size, counted from behind these.

mod decode;
mod encode;
#[cfg(test)]
mod tests;

pub use decode::decode;
pub use encode::encode;

/// How a message in little-endian order begins.
const LITTLE: [u8; 4] = [0, 1, 0, 0];
/// How a message in big-endian order begins.
const BIG: [u8; 4] = [0, 0, 0, 0];
