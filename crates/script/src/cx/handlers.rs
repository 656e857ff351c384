//! Functions that scripts pass to be called later.

use super::Cx;
use crate::binding::args::ScriptFunction;
use crate::calls::handler::{Handler, HeldFunction, ScriptCallback};

impl Handler {
    /// From a parameter of the calling script.
    pub fn new(cx: &Cx, given: ScriptFunction) -> Self {
        match given {
            ScriptFunction::Name(name) => Self::Name(name),
            ScriptFunction::Value(function) => {
                Self::Function(HeldFunction::new(cx.env(), function))
            }
        }
    }
}

impl ScriptCallback {
    /// From a parameter of the calling script.
    pub fn new(cx: &Cx, given: ScriptFunction) -> Self {
        Self::of(cx.env(), Handler::new(cx, given))
    }
}
