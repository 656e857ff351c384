//! Functions of scripts that the host knows.

/// A function of a script, by the number its interpreter knows it by until it is released.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FunctionRef(i32);

impl FunctionRef {
    /// The function that the interpreter knows by `number`.
    pub fn new(number: i32) -> Self {
        Self(number)
    }

    /// The number by which the interpreter knows it.
    pub fn number(self) -> i32 {
        self.0
    }
}
