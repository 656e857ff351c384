//! Results of socket functions.

use std::rc::Rc;

use super::Sockets;
use crate::Result;
use io::socket::Failure;
use script::IntoScript;
use script::{ApiError, LuaObject, Sink};

/// The most memory that is kept for the next call.
const MAX_KEPT_CAPACITY: usize = 1 << 16;

/// A value, or nil and why there is none.
pub(super) struct Outcome<T>(pub std::result::Result<T, Failure>);

impl<T: IntoScript> IntoScript for Outcome<T> {
    const TYPE: &'static str = T::TYPE;

    fn into_script<S: Sink>(self, sink: &mut S) -> Result<()> {
        match self.0 {
            Ok(value) => value.into_script(sink),
            Err(failure) => push_failure(sink, failure),
        }
    }
}

/// Nil and the text; what must not be overlooked becomes an error.
pub(super) fn push_failure(sink: &mut impl Sink, failure: Failure) -> Result<()> {
    match failure {
        Failure::Interrupted => Err(ApiError::Interrupted),
        Failure::TooLong => Err(ApiError::Other(failure.text().to_owned())),
        _ => {
            sink.nil();
            sink.text(failure.text().as_bytes());
            Ok(())
        }
    }
}

/// LuaSocket's way to say that all is well: the number 1.
pub(super) fn done(result: std::result::Result<(), Failure>) -> Outcome<f64> {
    Outcome(result.map(|()| 1.0))
}

/// A new object.
pub(super) struct Created(pub LuaObject);

impl IntoScript for Created {
    const TYPE: &'static str = "any";

    fn into_script<S: Sink>(self, sink: &mut S) -> Result<()> {
        sink.object(self.0)
    }
}

/// Data, nil, nil; or nil, why, and what came before.
pub(super) struct Received {
    pub sockets: Rc<Sockets>,
    pub data: Vec<u8>,
    pub result: std::result::Result<(), Failure>,
}

impl IntoScript for Received {
    const TYPE: &'static str = "string";

    fn into_script<S: Sink>(self, sink: &mut S) -> Result<()> {
        push_progress(sink, self.result, |sink| sink.text(&self.data))?;
        if self.data.capacity() <= MAX_KEPT_CAPACITY {
            self.sockets.space.set(self.data);
        }
        Ok(())
    }
}

/// The last byte sent, nil, nil; or nil, why, and the last byte sent.
pub(super) struct Sent {
    pub last: f64,
    pub result: std::result::Result<(), Failure>,
}

impl IntoScript for Sent {
    const TYPE: &'static str = "float";

    fn into_script<S: Sink>(self, sink: &mut S) -> Result<()> {
        push_progress(sink, self.result, |sink| sink.number(self.last))
    }
}

/// How far it came, nil, nil; or nil, why, and how far it came.
fn push_progress<S: Sink>(
    sink: &mut S,
    result: std::result::Result<(), Failure>,
    push: impl FnOnce(&mut S),
) -> Result<()> {
    match result {
        Ok(()) => {
            push(sink);
            sink.nil();
            sink.nil();
        }
        Err(failure) => {
            push_failure(sink, failure)?;
            push(sink);
        }
    }
    Ok(())
}
