//! The physics on scenes built by hand.

use super::*;
