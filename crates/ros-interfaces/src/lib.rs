//! Message, service and action types of ROS 1 and ROS 2, and values of these types.
//!
//! A [`Catalogue`] knows the types by name: the common packages are built in, others are read from `.msg`, `.srv` and `.action`
//! files when they are first asked for. It returns a [`Layout`], in which nested types are resolved, so that a codec walks it together with a [`Record`]
//! and looks up no name. The bytes of ROS 1 are in [`ros1`]; the bytes of ROS 2 (CDR) and both networks are elsewhere.
//!
//! Texts and bytes may come from anyone: sizes, nesting and lengths are limited ([`limits`]) and checked before memory is allocated.

mod catalogue;
pub mod cdr;
mod error;
pub mod limits;
mod name;
mod number;
pub mod parse;
pub mod ros1;
mod type_hash;
mod types;
mod value;

pub use catalogue::Catalogue;
pub use error::{DecodeError, InterfaceError, ValueError};
pub use name::{InterfaceKind, TypeName};
pub use number::{ByteOrder, Number, NumberType, Numbers};
pub use type_hash::type_hash;
pub use types::{Constant, Element, Field, FieldType, Interface, Layout, Shape, Structure};
pub use value::{Array, Duration, Record, Time, Value};

/// Which of the two systems a text, a name or a catalogue belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Generation {
    /// ROS 1: `time` and `duration` are primitive types, `Header` is `std_msgs/Header`, fields have no default values.
    Ros1,
    /// ROS 2: default values, bounds, `wstring`.
    Ros2,
}
