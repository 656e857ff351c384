//! A command that is being executed: what it reads and writes, and how it calls functions.

use super::service::Service;
use permissions::Denied;
use scene::numbers;
use scene::{Data, SceneError};
use script::{ApiError, Host};
use wire::simx::{FieldReader, FieldWriter, Violation};

/// Why a command fails.
#[derive(Debug)]
pub(super) enum Failure {
    /// The text is for the client's list of errors.
    Text(String),
    /// Nothing is to be said: the answer itself says it.
    Silent,
}

pub(super) type Outcome = Result<(), Failure>;

impl From<Violation> for Failure {
    fn from(_: Violation) -> Self {
        Self::Text("the data of the command is incomplete.".into())
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        Self::Text(error.to_string())
    }
}

impl From<Denied> for Failure {
    fn from(error: Denied) -> Self {
        Self::Text(error.to_string())
    }
}

/// One execution of a command.
pub(super) struct Call<'a> {
    pub host: &'a Host<'a>,
    pub service: &'a Service,
    pub key: FieldReader<'a>,
    pub data: FieldReader<'a>,
    /// The data of the answer.
    pub out: FieldWriter,
    /// A stream ends with this answer.
    pub ends_stream: bool,
}

impl Call<'_> {
    /// Calls a function of `sim`.
    ///
    /// # Errors
    /// Those of the function, under the name that they have in the original.
    pub(super) fn api(&self, function: &str, args: &[Data]) -> Result<Vec<Data>, Failure> {
        self.host
            .call_api(function, args)
            .map_err(|error| described(function, &error))
    }

    /// The first result of a function, which must not be nil.
    ///
    /// # Errors
    /// Those of the function; when there is no result.
    pub(super) fn value(&self, function: &str, args: &[Data]) -> Result<Data, Failure> {
        let value = self
            .api(function, args)?
            .into_iter()
            .next()
            .unwrap_or(Data::Nil);
        if value == Data::Nil {
            Err(Failure::Silent)
        } else {
            Ok(value)
        }
    }

    /// A first result that is an integer.
    ///
    /// # Errors
    /// Those of the function; when there is no such result.
    pub(super) fn integer(&self, function: &str, args: &[Data]) -> Result<i64, Failure> {
        self.value(function, args).map(|value| integer(&value))
    }

    /// The next handle of the key.
    ///
    /// # Errors
    /// When there is none.
    pub(super) fn handle(&mut self) -> Result<Data, Failure> {
        Ok(Data::Int(self.key.int()?.into()))
    }

    /// The next text of the key.
    ///
    /// # Errors
    /// When there is none.
    pub(super) fn name(&mut self) -> Result<String, Failure> {
        Ok(String::from_utf8_lossy(self.key.text()?).into_owned())
    }

    /// The integers that are left.
    ///
    /// # Errors
    /// When their bytes are not complete.
    pub(super) fn integers(&mut self) -> Result<Vec<i64>, Failure> {
        let mut integers = Vec::new();
        while !self.data.is_empty() {
            integers.push(self.data.int()?.into());
        }
        Ok(integers)
    }

    /// So many numbers, as a table.
    ///
    /// # Errors
    /// When there are fewer.
    pub(super) fn numbers(&mut self, count: usize) -> Result<Data, Failure> {
        let numbers = (0..count)
            .map(|_| self.data.float().map(f64::from))
            .collect::<Result<Vec<_>, _>>()?;
        Ok(numbers.into())
    }

    /// Writes so many integers, and how many.
    pub(super) fn write_list(&mut self, integers: &[i64]) {
        self.out.size(integers.len());
        integers
            .iter()
            .for_each(|&value| self.out.int(clamped(value)));
    }

    /// Writes an integer.
    pub(super) fn write_int(&mut self, value: i64) {
        self.out.int(clamped(value));
    }

    /// Writes the numbers of a value: one, or those of a table.
    pub(super) fn write_floats(&mut self, value: &Data) {
        floats(value)
            .into_iter()
            .for_each(|value| self.out.float(value));
    }
}

/// An error as the client reads it: with the name of the function in V-REP's way.
pub(super) fn described(function: &str, error: &ApiError) -> Failure {
    let name = function
        .rsplit('.')
        .next()
        .unwrap_or(function)
        .trim_start_matches('_');
    let (first, rest) = name.split_at_checked(1).unwrap_or((name, ""));
    let text = error.to_string();
    let text = text
        .rsplit_once(": ")
        .filter(|(place, _)| place.contains(" in sim."))
        .map_or(&*text, |(_, text)| text);
    Failure::Text(format!("[sim{}{rest}] {text}", first.to_ascii_uppercase()))
}

/// The nearest integer that the protocol has.
fn clamped(value: i64) -> i32 {
    let limit = if value < 0 { i32::MIN } else { i32::MAX };
    i32::try_from(value).unwrap_or(limit)
}

/// A value as an integer: truth is 1.
pub(super) fn integer(value: &Data) -> i64 {
    match *value {
        Data::Int(value) => value,
        Data::Float(value) => numbers::truncated(value),
        Data::Bool(value) => value.into(),
        _ => 0,
    }
}

/// The numbers of a value.
pub(super) fn floats(value: &Data) -> Vec<f32> {
    match value {
        Data::Array(items) => items.iter().flat_map(floats).collect(),
        value => vec![numbers::single(value.as_f64().unwrap_or_default())],
    }
}

/// The bytes of a value.
pub(super) fn bytes(value: &Data) -> &[u8] {
    match value {
        Data::Text(bytes) | Data::Buffer(bytes) => bytes,
        _ => &[],
    }
}
