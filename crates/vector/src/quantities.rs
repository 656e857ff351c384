//! Quantities and actions, found in a scene once and read or written many times.

use scene::{Data, ValueType};
use simulator::{PreparedCall, Simulator, property_getter, property_setter};

use crate::declaration::{Action, Quantity};
use crate::expressions::Expressions;

/// `sim.jointdynctrl_*`.
mod control {
    pub const FORCE: i64 = 1;
    pub const VELOCITY: i64 = 4;
    pub const POSITION: i64 = 8;
}

/// Quantities in one simulator.
pub struct Readers {
    all: Vec<Reader>,
    width: usize,
}

struct Reader {
    what: String,
    call: Call,
    /// How many numbers it reads; None before it was read.
    width: Option<usize>,
}

/// How numbers are read or written.
pub(crate) enum Call {
    /// A function of the API, with its first arguments.
    Api(PreparedCall),
    /// A function of a script.
    Script(simulator::ScriptRef, String),
    /// An expression or statement.
    Expression(i64),
}

impl Call {
    fn is_api(&self) -> bool {
        self.api().is_some()
    }

    fn api(&self) -> Option<&PreparedCall> {
        match self {
            Self::Api(call) => Some(call),
            Self::Script(..) | Self::Expression(_) => None,
        }
    }

    /// The results for further arguments.
    pub(crate) fn perform(
        &self,
        simulator: &mut Simulator,
        expressions: &Expressions,
        more: &[Data],
    ) -> Result<Vec<Data>, String> {
        let results = match self {
            Self::Api(call) => simulator.call_once(call, more),
            Self::Script(script, function) => simulator.call(script, function, more),
            Self::Expression(number) => return expressions.run(simulator, *number, more),
        };
        results.map_err(|error| error.to_string())
    }
}

/// The object at a path.
pub(crate) fn object(simulator: &mut Simulator, path: &str) -> Result<i64, String> {
    let found = simulator.call_api("sim.getObject", &[Data::text(path)]);
    match found.map_err(|error| format!("'{path}': {error}"))?.first() {
        Some(Data::Int(handle)) => Ok(*handle),
        _ => Err(format!("'{path}': there is no such object.")),
    }
}

/// How a property is read or written, by the function that `of_type` names.
pub(crate) fn property(
    simulator: &mut Simulator,
    path: &str,
    name: &str,
    of_type: fn(ValueType) -> &'static str,
) -> Result<Call, String> {
    let handle = object(simulator, path)?;
    let ty = simulator.property_type(handle, name);
    let ty = ty.map_err(|error| format!("property '{name}' of '{path}': {error}"))?;
    let args = vec![Data::Int(handle), Data::text(name)];
    Ok(Call::Api(simulator.prepare_call(of_type(ty), args)))
}

fn function(simulator: &mut Simulator, path: &str, name: &str) -> Result<Call, String> {
    let handle = object(simulator, path)?;
    let script = scene::Handle::from_raw(handle)
        .and_then(|handle| simulator.script(handle).ok())
        .ok_or_else(|| format!("'{path}' is no script."))?;
    Ok(Call::Script(script, name.to_owned()))
}

impl Readers {
    /// Finds quantities in the scene, and reads each once.
    ///
    /// # Errors
    /// When one cannot be found or is no number; the text names it.
    pub fn new(
        simulator: &mut Simulator,
        expressions: &Expressions,
        quantities: &[Quantity],
    ) -> Result<Self, String> {
        let mut all = Vec::with_capacity(quantities.len());
        for quantity in quantities {
            let call = reader(simulator, expressions, quantity)?;
            let mut reader = Reader {
                what: quantity.to_string(),
                call,
                width: None,
            };
            let mut values = Vec::new();
            reader.read(simulator, expressions, &mut values)?;
            reader.width = Some(values.len());
            all.push(reader);
        }
        let width = all.iter().filter_map(|reader| reader.width).sum();
        Ok(Self { all, width })
    }

    /// How many numbers there are.
    pub fn width(&self) -> usize {
        self.width
    }

    /// How many numbers each quantity has.
    pub fn widths(&self) -> Vec<usize> {
        self.all.iter().filter_map(|reader| reader.width).collect()
    }

    /// Reads them all.
    ///
    /// # Errors
    /// When one fails, or has another number of numbers than at first.
    pub fn read(
        &self,
        simulator: &mut Simulator,
        expressions: &Expressions,
    ) -> Result<Vec<f64>, String> {
        let mut values = Vec::with_capacity(self.width);
        for readers in self.all.chunk_by(|a, b| a.call.is_api() && b.call.is_api()) {
            match readers {
                [reader] => reader.read(simulator, expressions, &mut values)?,
                readers => values = read_together(readers, simulator, &values)?,
            }
        }
        Ok(values)
    }
}

/// Adds what readers of functions of the API read.
fn read_together(
    readers: &[Reader],
    simulator: &mut Simulator,
    before: &Vec<f64>,
) -> Result<Vec<f64>, String> {
    let calls = readers.iter().filter_map(|reader| reader.call.api());
    let calls = calls.map(|call| (call, None));
    let add = |values: &mut Vec<f64>, number: usize, results: &[Data]| {
        readers[number].add(results, values)
    };
    let read = simulator.call_prepared(calls, before, add);
    read.map_err(|(number, error)| format!("{}: {error}", readers[number].what))
}

impl Reader {
    fn read(
        &self,
        simulator: &mut Simulator,
        expressions: &Expressions,
        values: &mut Vec<f64>,
    ) -> Result<(), String> {
        let results = self.call.perform(simulator, expressions, &[]);
        let added = results.and_then(|results| self.add(&results, values));
        added.map_err(|error| format!("{}: {error}", self.what))
    }

    /// Adds the numbers of its results.
    fn add(&self, results: &[Data], values: &mut Vec<f64>) -> Result<(), String> {
        let before = values.len();
        let is_number = |data| add_numbers(data, values);
        if results.is_empty() || !results.iter().all(is_number) {
            return Err("numbers are needed, or lists of them.".to_owned());
        }
        let count = values.len() - before;
        let expected = self.width.unwrap_or(count);
        (count == expected)
            .then_some(())
            .ok_or_else(|| format!("{count} numbers, where there were {expected} at first."))
    }
}

/// Adds the numbers of a value; false where it has something else.
pub(crate) fn add_numbers(data: &Data, values: &mut Vec<f64>) -> bool {
    match data {
        Data::Bool(truth) => values.push(f64::from(u8::from(*truth))),
        Data::Array(items) => return items.iter().all(|item| add_numbers(item, values)),
        data => match data.as_f64() {
            Some(number) => values.push(number),
            None => return false,
        },
    }
    true
}

fn reader(
    simulator: &mut Simulator,
    expressions: &Expressions,
    quantity: &Quantity,
) -> Result<Call, String> {
    let (api, path) = match quantity {
        Quantity::JointPosition(path) => ("sim.getJointPosition", path),
        Quantity::JointVelocity(path) => ("sim.getJointVelocity", path),
        Quantity::JointForce(path) => ("sim.getJointForce", path),
        Quantity::Position(path) => ("sim.getObjectPosition", path),
        Quantity::Quaternion(path) => ("sim.getObjectQuaternion", path),
        Quantity::Velocity(path) => ("sim.getObjectVelocity", path),
        Quantity::Property(path, name) => {
            return property(simulator, path, name, property_getter);
        }
        Quantity::Function(path, name) => return function(simulator, path, name),
        Quantity::Expression(text) => {
            let name = quantity.to_string();
            let number = expressions.compile(simulator, &name, "return", text)?;
            return Ok(Call::Expression(number));
        }
    };
    let args = vec![Data::Int(object(simulator, path)?)];
    Ok(Call::Api(simulator.prepare_call(api, args)))
}

/// Actions in one simulator.
pub struct Writers(Vec<Writer>);

struct Writer {
    what: String,
    call: Call,
}

impl Writers {
    /// Finds actions in the scene; motors get the control that they need.
    ///
    /// # Errors
    /// When one cannot be found; the text names it.
    pub fn new(
        simulator: &mut Simulator,
        expressions: &Expressions,
        actions: &[Action],
    ) -> Result<Self, String> {
        let writer = |action: &Action| {
            Ok(Writer {
                what: action.to_string(),
                call: writer(simulator, expressions, action)?,
            })
        };
        Ok(Self(
            actions.iter().map(writer).collect::<Result<_, String>>()?,
        ))
    }

    /// How many numbers there are.
    pub fn width(&self) -> usize {
        self.0.len()
    }

    /// Writes them all.
    ///
    /// # Errors
    /// When one fails; the text names it.
    pub fn write(
        &self,
        simulator: &mut Simulator,
        expressions: &Expressions,
        values: &[f64],
    ) -> Result<(), String> {
        let mut values = values.iter().copied();
        for writers in self.0.chunk_by(|a, b| a.call.is_api() && b.call.is_api()) {
            match writers {
                [writer] => writer.write(simulator, expressions, &mut values)?,
                writers => write_together(writers, simulator, &mut values)?,
            }
        }
        Ok(())
    }
}

impl Writer {
    fn write(
        &self,
        simulator: &mut Simulator,
        expressions: &Expressions,
        values: &mut impl Iterator<Item = f64>,
    ) -> Result<(), String> {
        let value: Vec<_> = values.take(1).map(Data::Float).collect();
        let results = self.call.perform(simulator, expressions, &value);
        let results = results.map_err(|error| format!("{}: {error}", self.what));
        results.map(|_| ())
    }
}

/// Writes by functions of the API.
fn write_together(
    writers: &[Writer],
    simulator: &mut Simulator,
    values: &mut impl Iterator<Item = f64>,
) -> Result<(), String> {
    let calls = writers.iter().filter_map(|writer| writer.call.api());
    let calls = calls.zip(values.map(Some));
    let written = simulator.call_prepared(calls, &(), |(), _, _| Ok(()));
    written.map_err(|(number, error)| format!("{}: {error}", writers[number].what))
}

fn writer(
    simulator: &mut Simulator,
    expressions: &Expressions,
    action: &Action,
) -> Result<Call, String> {
    let (api, path, mode) = match action {
        Action::TargetForce(path) => ("sim.setJointTargetForce", path, control::FORCE),
        Action::TargetVelocity(path) => ("sim.setJointTargetVelocity", path, control::VELOCITY),
        Action::TargetPosition(path) => ("sim.setJointTargetPosition", path, control::POSITION),
        Action::Property(path, name) => {
            return property(simulator, path, name, property_setter);
        }
        Action::Function(path, name) => return function(simulator, path, name),
        Action::Statement(text) => {
            let name = action.to_string();
            let number = expressions.compile(simulator, &name, "local x = ...;", text)?;
            return Ok(Call::Expression(number));
        }
    };
    let joint = Data::Int(object(simulator, path)?);
    let args = [joint.clone(), Data::text("dynCtrlMode"), Data::Int(mode)];
    let set = simulator.call_api("sim.setIntProperty", &args);
    set.map_err(|error| format!("{action}: {error}"))?;
    Ok(Call::Api(simulator.prepare_call(api, vec![joint])))
}

impl std::fmt::Display for Quantity {
    /// As errors name it.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::JointPosition(path) => write!(f, "the joint position of {path}"),
            Self::JointVelocity(path) => write!(f, "the joint velocity of {path}"),
            Self::JointForce(path) => write!(f, "the joint force of {path}"),
            Self::Position(path) => write!(f, "the position of {path}"),
            Self::Quaternion(path) => write!(f, "the quaternion of {path}"),
            Self::Velocity(path) => write!(f, "the velocity of {path}"),
            Self::Property(path, name) => write!(f, "the property {name} of {path}"),
            Self::Function(path, name) => write!(f, "the function {name} of {path}"),
            Self::Expression(text) => write!(f, "expression {text}"),
        }
    }
}

impl std::fmt::Display for Action {
    /// As errors name it.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::TargetPosition(path) => write!(f, "the target position of {path}"),
            Self::TargetVelocity(path) => write!(f, "the target velocity of {path}"),
            Self::TargetForce(path) => write!(f, "the target force of {path}"),
            Self::Property(path, name) => write!(f, "the property {name} of {path}"),
            Self::Function(path, name) => write!(f, "the function {name} of {path}"),
            Self::Statement(text) => write!(f, "statement {text}"),
        }
    }
}
