//! What a function has returned, or why it failed.

use capture::{Input, Recorded};
use scene::Data;

use super::values;
use crate::error::ApiError;

/// One result of a function.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Output {
    /// A plain value.
    Plain(Data),
    /// An object of a library, by the numbers of its class and of itself.
    Object { class: i64, id: i64 },
}

/// All results, or the error.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Outcome(pub(crate) Result<Vec<Output>, ApiError>);

const PLAIN: u8 = 0;
const OBJECT: u8 = 1;

impl Recorded for Output {
    fn write(&self, out: &mut Vec<u8>) {
        match self {
            Self::Plain(data) => {
                out.push(PLAIN);
                values::write(data, out);
            }
            Self::Object { class, id } => {
                out.push(OBJECT);
                class.write(out);
                id.write(out);
            }
        }
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        Some(match input.byte()? {
            PLAIN => Self::Plain(values::read(input, 0)?),
            OBJECT => Self::Object {
                class: Recorded::read(input)?,
                id: Recorded::read(input)?,
            },
            _ => return None,
        })
    }
}

/// The errors whose words depend on the call, or that are no refusals; of all others only the words are left.
const MORE_ARGUMENTS: u8 = 0;
const ARGUMENT_TYPE: u8 = 1;
const NOT_IMPLEMENTED: u8 = 2;
const NEEDS_LUA: u8 = 3;
const INTERRUPTED: u8 = 4;
const BAD_ARGUMENT: u8 = 5;
const OTHER: u8 = 6;

impl Recorded for Outcome {
    fn write(&self, out: &mut Vec<u8>) {
        self.0.is_ok().write(out);
        match &self.0 {
            Ok(outputs) => outputs.write(out),
            Err(error) => write_error(error, out),
        }
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        Some(Self(if bool::read(input)? {
            Ok(Recorded::read(input)?)
        } else {
            Err(read_error(input)?)
        }))
    }
}

fn write_error(error: &ApiError, out: &mut Vec<u8>) {
    let (tag, number, text) = match error {
        ApiError::MoreArguments => (MORE_ARGUMENTS, 0, String::new()),
        ApiError::ArgumentType => (ARGUMENT_TYPE, 0, String::new()),
        ApiError::NotImplemented(what) => (NOT_IMPLEMENTED, 0, what.clone()),
        ApiError::NeedsLua => (NEEDS_LUA, 0, String::new()),
        ApiError::Interrupted => (INTERRUPTED, 0, String::new()),
        ApiError::BadArgument { position, reason } => (BAD_ARGUMENT, *position, reason.clone()),
        other => (OTHER, 0, other.to_string()),
    };
    out.push(tag);
    number.write(out);
    text.write(out);
}

fn read_error(input: &mut Input<'_>) -> Option<ApiError> {
    let (tag, position, text) = (input.byte()?, i32::read(input)?, String::read(input)?);
    Some(match tag {
        MORE_ARGUMENTS => ApiError::MoreArguments,
        ARGUMENT_TYPE => ApiError::ArgumentType,
        NOT_IMPLEMENTED => ApiError::NotImplemented(text),
        NEEDS_LUA => ApiError::NeedsLua,
        INTERRUPTED => ApiError::Interrupted,
        BAD_ARGUMENT => ApiError::BadArgument {
            position,
            reason: text,
        },
        OTHER => ApiError::Other(text),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outcomes_come_back() {
        let bad = ApiError::BadArgument {
            position: 2,
            reason: "number expected".into(),
        };
        let outputs = vec![
            Output::Plain(Data::Nil),
            Output::Object { class: 3, id: -1 },
        ];
        for outcome in [
            Ok(outputs),
            Err(bad),
            Err(ApiError::Interrupted),
            Err(ApiError::NotImplemented("x".into())),
            Err(ApiError::Other("y".into())),
        ] {
            let (outcome, mut bytes) = (Outcome(outcome), Vec::new());
            outcome.write(&mut bytes);
            assert_eq!(Outcome::read(&mut Input::new(&bytes)), Some(outcome));
        }
        let (mut bytes, words) = (Vec::new(), ApiError::NoSuchScript.to_string());
        Outcome(Err(ApiError::NoSuchScript)).write(&mut bytes);
        let read = Outcome::read(&mut Input::new(&bytes));
        assert_eq!(read, Some(Outcome(Err(ApiError::Other(words)))));
        assert!(Outcome::read(&mut Input::new(&[0, 77, 0, 0])).is_none());
    }
}
