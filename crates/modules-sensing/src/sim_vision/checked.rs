//! Arguments whose errors have the words of CoppeliaSim's plugins.

use crate::{ApiError, Args, FromScript, Result};
use script::Source;

/// An argument that must be there and be right. `#[api]` leaves it to this type to say that it is not there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Checked<T>(pub T);

impl<T> From<T> for Checked<T> {
    fn from(value: T) -> Self {
        Self(value)
    }
}

impl<T: FromScript> FromScript for Checked<T> {
    const TYPE: &'static str = T::TYPE;

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> Result<Self> {
        T::from_script(args).map(Self).map_err(|error| worded(&error, i64::from(args.position())))
    }
}

fn worded(error: &ApiError, position: i64) -> ApiError {
    match error {
        ApiError::MoreArguments => ApiError::Other("Not enough arguments.".into()),
        ApiError::TableSize => wrong_size(position),
        _ => wrong(position),
    }
}

/// The error for an argument of the wrong type or value.
pub(super) fn wrong(position: i64) -> ApiError {
    ApiError::Other(format!("Argument {position} is not correct."))
}

/// The error for a table that is too short.
pub(super) fn wrong_size(position: i64) -> ApiError {
    ApiError::Other(format!("Argument {position} is not correct (wrong table size)."))
}
