//! Decoding: from the values on a Lua stack to the parameters of an API function.
//!
//! Every type that scripts can pass in implements [`FromScript`]. Typing rules are those of CoppeliaSim (spec: conventions 3): a
//! number may be a numeric string, an integer must be one, a string may be a number or a buffer, anything is a bool, tables may be
//! longer than needed.

use std::ffi::c_int;
use std::marker::PhantomData;

use super::returns::IntoScript;
use super::source::{Caller, Source};
use crate::error::{ApiError, ApiResult};
use crate::function_ref::FunctionRef;
use crate::lua::{LuaObject, Stack, Type};
use scene::{Data, Frame, Handle};

/// Reads the arguments of one call in order.
pub struct Args<'a, S: Source<'a> = Stack<'a>> {
    source: S,
    of: PhantomData<&'a ()>,
    position: c_int,
    count: c_int,
    /// Of a plugin's function: integers may be floats.
    of_plugin: bool,
}

/// By how much floats that plugins take for integers are moved away from zero before their fraction is cut, so that one that rounding has
/// put just below an integer counts in full.
const PLUGIN_ROUNDING: f64 = 0.1;

/// A type that scripts can pass in.
pub trait FromScript: Sized {
    /// The type in the words of the reference.
    const TYPE: &'static str;

    /// What a missing argument is to this type, where the parameter has no default.
    const ABSENCE: Absence = Absence::Refused;

    /// The value of argument `args.position()`.
    ///
    /// # Errors
    /// When the argument is of another type.
    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> ApiResult<Self>;
}

/// What a missing argument is to a type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Absence {
    /// An error, which the call raises before it decodes any argument.
    Refused,
    /// The same as nil, which is one of the type's values.
    Nil,
    /// What decoding makes of it: an error in words of the type's own, or a list without elements.
    Decoded,
}

impl<'a> Args<'a> {
    /// The stack the arguments are on, for functions that decode them themselves.
    pub fn stack(&self) -> Stack<'a> {
        self.source
    }

    /// Encodes the results.
    pub fn finish<T: IntoScript>(&self, results: T) -> ApiResult<c_int> {
        let mut stack = self.source;
        let before = stack.top();
        results.into_script(&mut stack)?;
        Ok(stack.top() - before)
    }
}

impl<'a, S: Source<'a>> Args<'a, S> {
    pub(crate) fn new(source: S) -> Self {
        Self {
            source,
            of: PhantomData,
            position: 0,
            count: source.count(),
            of_plugin: false,
        }
    }

    /// Arguments for the function of a plugin, which takes floats where it expects integers.
    pub(crate) fn for_plugin(self, of_plugin: bool) -> Self {
        Self { of_plugin, ..self }
    }

    /// A float that stands for an integer.
    fn truncated(&self, number: f64) -> i64 {
        if self.of_plugin {
            numbers::truncated(number + PLUGIN_ROUNDING.copysign(number))
        } else {
            numbers::truncated(number)
        }
    }

    fn integer(&self) -> ApiResult<i64> {
        let integer = self.source.integer(self.position);
        let number = || {
            let number = self.source.number(self.position);
            number.filter(|_| self.of_plugin && self.kind() == Type::Number)
        };
        integer
            .or_else(|| number().map(|number| self.truncated(number)))
            .ok_or_else(|| self.not_a("integer"))
    }

    /// Number of the argument being decoded, from 1.
    pub fn position(&self) -> c_int {
        self.position
    }

    pub(crate) fn kind(&self) -> Type {
        if self.position > self.count {
            Type::None
        } else {
            self.source.kind(self.position)
        }
    }

    /// Reads the bytes of the argument, when it is a string.
    pub fn with_bytes<T>(&self, read: impl FnOnce(&[u8]) -> T + Send) -> Option<T> {
        if self.position > self.count {
            None
        } else {
            self.source.with_bytes(self.position, read)
        }
    }

    /// Fails unless there are `count` arguments.
    #[expect(
        clippy::cast_sign_loss,
        reason = "a stack never has fewer than no values; every call of a function comes here"
    )]
    pub fn require(&self, count: usize) -> ApiResult<()> {
        if (self.count as usize) < count {
            Err(ApiError::MoreArguments)
        } else {
            Ok(())
        }
    }

    /// The next argument, which must be there.
    pub fn take<T: FromScript>(&mut self) -> ApiResult<T> {
        self.position += 1;
        T::from_script(self)
    }

    /// The next argument, or the default when it is missing or nil.
    pub fn take_or<T: FromScript>(&mut self, default: impl FnOnce() -> T) -> ApiResult<T> {
        self.position += 1;
        match self.kind() {
            Type::None | Type::Nil => Ok(default()),
            _ => T::from_script(self),
        }
    }

    /// On whose behalf the function is called.
    pub(crate) fn caller(&self) -> Caller<'a> {
        self.source.caller()
    }

    /// The error for an argument of the wrong type.
    pub fn not_a(&self, expected: &'static str) -> ApiError {
        match self.kind() {
            Type::None => ApiError::MoreArguments,
            Type::Nil => ApiError::ArgumentType,
            _ => ApiError::NotA {
                position: self.position,
                expected,
            },
        }
    }

    /// The error of Lua's own functions for an argument of the wrong type.
    pub(crate) fn expected(&self, what: &str) -> ApiError {
        let found = match self.kind() {
            Type::None => "no value",
            Type::Nil => "nil",
            Type::Boolean => "boolean",
            Type::Number => "number",
            Type::String => "string",
            Type::Table => "table",
            Type::Function => "function",
            Type::UserData => "userdata",
            Type::LightUserData => "light userdata",
            Type::Thread => "thread",
        };
        self.refused(&format!("{what} expected, got {found}"))
    }

    /// The error of Lua's own functions for an argument they cannot take.
    pub fn refused(&self, reason: &str) -> ApiError {
        ApiError::BadArgument {
            position: self.position,
            reason: reason.into(),
        }
    }

    /// The argument, when it is an object of a library.
    pub fn object(&self) -> Option<LuaObject> {
        if self.position > self.count {
            None
        } else {
            self.source.object(self.position)
        }
    }

    /// The argument, when it is a number or a string of one.
    pub fn lua_number(&self) -> Option<f64> {
        self.number().ok()
    }

    /// Whether the argument at `position`, from 1, is a table.
    pub fn is_table(&self, position: c_int) -> bool {
        position <= self.count && self.source.kind(position) == Type::Table
    }

    fn number(&self) -> ApiResult<f64> {
        match self.kind() {
            Type::Number | Type::String => self
                .source
                .number(self.position)
                .ok_or_else(|| self.not_a("number")),
            _ => Err(self.not_a("number")),
        }
    }

    /// The numbers of a list. What its length claims is not allocated before it is there.
    fn numbers(&self) -> ApiResult<Vec<f64>> {
        const PIECE: usize = 512;
        let count = self.table_len()?;
        let mut numbers = Vec::new();
        while numbers.len() < count {
            let read = numbers.len();
            numbers.resize(count.min(read + PIECE), 0.0);
            self.read_numbers(numbers::count(read) + 1, &mut numbers[read..])?;
        }
        Ok(numbers)
    }

    fn read_numbers(&self, first: i64, out: &mut [f64]) -> ApiResult<()> {
        let all = self.source.numbers_into(self.position, first, out);
        if all { Ok(()) } else { Err(NO_NUMBER) }
    }

    /// The integers of a list; other numbers lose their fraction.
    fn integers(&self) -> ApiResult<Vec<i64>> {
        let element = |i| match self.source.integer_at(self.position, i) {
            Some(integer) => Ok(integer),
            None => self.element(i).map(|number| self.truncated(number)),
        };
        (1..=numbers::count(self.table_len()?))
            .map(element)
            .collect()
    }

    fn element(&self, i: i64) -> ApiResult<f64> {
        self.source.number_at(self.position, i).ok_or(NO_NUMBER)
    }

    fn table_len(&self) -> ApiResult<usize> {
        if self.kind() == Type::Table {
            Ok(self.source.list_len(self.position))
        } else {
            Err(self.not_a("table"))
        }
    }

    fn fill(&self, out: &mut [f64]) -> ApiResult<()> {
        if self.table_len()? < out.len() {
            return Err(ApiError::TableSize);
        }
        self.read_numbers(1, out)
    }
}

/// An element of a list is no number.
const NO_NUMBER: ApiError = ApiError::NotA {
    position: -1,
    expected: "number",
};

macro_rules! scalars {
    ($($ty:ty, $name:literal, |$args:ident| $decode:expr;)*) => { $(
        impl FromScript for $ty {
            const TYPE: &'static str = $name;
            fn from_script<'a, S: Source<'a>>($args: &Args<'a, S>) -> ApiResult<Self> { $decode }
        }
    )* };
}

scalars! {
    f64, "float", |args| args.number();
    i64, "int", |args| args.integer();
    bool, "bool", |args| Ok(args.source.truthy(args.position));
    String, "string", |args| Ok(String::from_utf8_lossy(&Bytes::from_script(args)?.0).into_owned());
    Number, "int", |args| Ok(Number(args.truncated(args.number()?)));
    Bytes, "buffer", |args| match args.source.data(args.position)? {
        Data::Text(bytes) | Data::Buffer(bytes) => Ok(Bytes(bytes)),
        Data::Int(_) | Data::Float(_) => Ok(Bytes(args.source.text(args.position).unwrap_or_default())),
        _ => Err(args.not_a("string/buffer")),
    };
    Data, "any", |args| args.source.data(args.position);
    Frame, "int", |args| Ok(Frame::from_raw(numbers::truncated(args.number()?))?);
    Handle, "int", |args| Handle::from_raw(numbers::truncated(args.number()?)).ok_or(scene::SceneError::NoSuchObject.into());
    ObjectRef, "int", |args| ObjectRef::from_raw(numbers::truncated(args.number()?));
    Handles, "int[]", |args| args.integers().map(Handles);
    Vec<f64>, "float[]", |args| args.numbers();
    Vec<i64>, "int[]", |args| args.integers();
    Vec<String>, "string[]", |args| match args.source.data(args.position)? {
        Data::Array(items) => items.into_iter().map(text).collect(),
        Data::Map(entries) if entries.is_empty() => Ok(Vec::new()),
        _ => Err(args.not_a("table")),
    };
    Table, "table", |args| match args.source.data(args.position)? {
        data @ (Data::Array(_) | Data::Map(_)) => Ok(Table(data)),
        _ => Err(args.not_a("table")),
    };
    ScriptFunction, "function", |args| match args.kind() {
        Type::Function => Ok(ScriptFunction::Value(args.source.function(args.position)?)),
        _ => Ok(ScriptFunction::Name(String::from_script(args)?)),
    };
    LuaString, "string", |args| match args.kind() {
        Type::String => Ok(LuaString(args.with_bytes(<[u8]>::to_vec).unwrap_or_default())),
        Type::Number => Ok(LuaString(args.source.text(args.position).unwrap_or_default())),
        _ => Err(args.expected("string")),
    };
    LuaNumber, "float", |args| args.number().map(LuaNumber).map_err(|_| args.expected("number"));
}

/// An element of a list of strings.
fn text(item: Data) -> ApiResult<String> {
    match item {
        Data::Text(bytes) | Data::Buffer(bytes) => Ok(String::from_utf8_lossy(&bytes).into_owned()),
        _ => Err(ApiError::NotA {
            position: -1,
            expected: "string",
        }),
    }
}

macro_rules! number_arrays {
    ($($n:literal $name:literal),*) => { $(
        impl FromScript for [f64; $n] {
            const TYPE: &'static str = $name;
            fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> ApiResult<Self> {
                let mut out = [0.0; $n];
                args.fill(&mut out)?;
                Ok(out)
            }
        }
    )* };
}
number_arrays!(2 "float[2]", 3 "float[3]", 4 "float[4]", 6 "float[6]", 7 "float[7]", 9 "float[9]", 12 "float[12]");

impl<T: FromScript> FromScript for Option<T> {
    const TYPE: &'static str = T::TYPE;
    const ABSENCE: Absence = Absence::Nil;

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> ApiResult<Self> {
        match args.kind() {
            Type::None | Type::Nil => Ok(None),
            _ => T::from_script(args).map(Some),
        }
    }
}

/// An integer that older functions read as a number: 2.7 is 2, and "2" is 2.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Number(pub i64);

impl From<i64> for Number {
    fn from(value: i64) -> Self {
        Self(value)
    }
}

impl From<Number> for Data {
    fn from(Number(value): Number) -> Self {
        Self::Int(value)
    }
}

/// Bytes of a string, a buffer or a number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Bytes(pub Vec<u8>);

impl From<Bytes> for Data {
    fn from(Bytes(bytes): Bytes) -> Self {
        Self::Buffer(bytes)
    }
}

/// A string or a number, as Lua's own functions accept it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LuaString(pub Vec<u8>);

impl LuaString {
    /// The text, with other bytes replaced.
    pub fn text(&self) -> std::borrow::Cow<'_, str> {
        String::from_utf8_lossy(&self.0)
    }
}

/// A number, as Lua's own functions accept it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LuaNumber(pub f64);

/// A table by value.
#[derive(Debug, Clone, PartialEq)]
pub struct Table(pub Data);

/// Without a table, an empty one: functions find as little in either.
impl From<Table> for Data {
    fn from(Table(data): Table) -> Self {
        if data == Self::Nil {
            Self::Array(Vec::new())
        } else {
            data
        }
    }
}

/// Object handles as passed: flags, special and unknown values included.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Handles(pub Vec<i64>);

/// An object handle with the flag bits a script added to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ObjectRef {
    /// The object, without flag bits.
    pub handle: Handle,
    flags: i64,
}

impl ObjectRef {
    fn from_raw(raw: i64) -> ApiResult<Self> {
        let handle = Handle::from_raw(raw).ok_or(scene::SceneError::NoSuchObject)?;
        Ok(Self {
            handle,
            flags: raw & !Handle::MASK,
        })
    }

    /// Whether all bits of `flag` were added.
    pub fn has(self, flag: i64) -> bool {
        self.flags & flag == flag
    }
}

/// A function, by value or by the name of a global.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ScriptFunction {
    /// The name of a global function, with dots for fields of tables.
    Name(String),
    /// The function itself.
    Value(#[doc(hidden)] FunctionRef),
}

/// An argument that is missed only after those before it were found right, as older functions check them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InTurn<T>(pub T);

impl<T> From<T> for InTurn<T> {
    fn from(value: T) -> Self {
        Self(value)
    }
}

impl<T: FromScript> FromScript for InTurn<T> {
    const TYPE: &'static str = T::TYPE;
    const ABSENCE: Absence = Absence::Decoded;

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> ApiResult<Self> {
        T::from_script(args).map(Self)
    }
}

/// All remaining arguments.
#[derive(Debug, Clone, PartialEq)]
pub struct Rest(pub Vec<Data>);

impl FromScript for Rest {
    const TYPE: &'static str = "any...";
    const ABSENCE: Absence = Absence::Decoded;

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> ApiResult<Self> {
        (args.position..=args.count)
            .map(|at| args.source.data(at))
            .collect::<Result<_, _>>()
            .map(Self)
    }
}
