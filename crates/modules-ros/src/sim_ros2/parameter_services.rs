//! The services by which other nodes list, read and set the parameters of the node (`ros2 param`).

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::rc::Rc;

use super::node::Running;
use super::parameters::{Parameter, Parameters};
use super::ros_values::{self, Style};
use super::services::{Server, without_empty_texts};
use super::{Cx, Result, interfaces};
use scene::Data;

/// What a service does with the parameters, for a request; the response.
type Handler = fn(&mut Parameters, &Data) -> Data;

/// Names of the services below the node, their types in rcl_interfaces, and what they do.
const SERVICES: [(&str, &str, Handler); 6] = [
    ("get_parameters", "GetParameters", get),
    ("get_parameter_types", "GetParameterTypes", types),
    ("set_parameters", "SetParameters", set),
    (
        "set_parameters_atomically",
        "SetParametersAtomically",
        set_atomically,
    ),
    ("describe_parameters", "DescribeParameters", describe),
    ("list_parameters", "ListParameters", list),
];

/// Types of values (rcl_interfaces/msg/ParameterType).
const NOT_SET: i64 = 0;
const BOOL: i64 = 1;
const INTEGER: i64 = 2;
const DOUBLE: i64 = 3;
const STRING: i64 = 4;

/// The servers of a node.
pub(super) struct ParameterServices(Vec<(Server, Handler)>);

impl ParameterServices {
    pub(super) fn new(cx: &Cx, running: &Rc<Running>) -> Result<Self> {
        let server = |(name, kind, handler): (&str, &str, Handler)| {
            let layouts = interfaces::service(cx, &format!("rcl_interfaces/srv/{kind}"))?;
            let full = running.resolve(&format!("~/{name}"))?;
            Ok((Server::new(running, &full, layouts), handler))
        };
        Ok(Self(
            SERVICES.into_iter().map(server).collect::<Result<_>>()?,
        ))
    }

    /// Answers the requests that have arrived.
    pub(super) fn spin(&self, parameters: &RefCell<Parameters>) {
        for (server, handler) in &self.0 {
            for (call, request) in server.arrived() {
                let request = ros_values::to_data(&request, Style::default());
                let response = handler(&mut parameters.borrow_mut(), &request);
                let response = without_empty_texts(response);
                let response = ros_values::from_data(&server.response, &response, Style::default());
                if let Ok(response) = response {
                    server.reply(call, &response);
                }
            }
        }
    }
}

fn items<'a>(request: &'a Data, field: &str) -> &'a [Data] {
    match request.field(field) {
        Some(Data::Array(items)) => items,
        _ => &[],
    }
}

fn text(data: Option<&Data>) -> String {
    match data {
        Some(Data::Text(bytes) | Data::Buffer(bytes)) => {
            String::from_utf8_lossy(bytes).into_owned()
        }
        _ => String::new(),
    }
}

fn names(request: &Data) -> impl Iterator<Item = String> + '_ {
    items(request, "names").iter().map(|name| text(Some(name)))
}

fn type_of(parameter: Option<&Parameter>) -> i64 {
    match parameter {
        None => NOT_SET,
        Some(Parameter::Bool(_)) => BOOL,
        Some(Parameter::Int(_)) => INTEGER,
        Some(Parameter::Double(_)) => DOUBLE,
        Some(Parameter::String(_)) => STRING,
    }
}

fn value_of(parameter: Option<&Parameter>) -> Data {
    let value = match parameter {
        None => ("integer_value", Data::Int(0)),
        Some(Parameter::Bool(value)) => ("bool_value", Data::Bool(*value)),
        Some(Parameter::Int(value)) => ("integer_value", Data::Int(*value)),
        Some(Parameter::Double(value)) => ("double_value", Data::Float(*value)),
        Some(Parameter::String(value)) => ("string_value", Data::text(value)),
    };
    Data::map([("type", Data::Int(type_of(parameter))), value])
}

/// The value that a message has; None for lists, which parameters of scripts are not.
fn read(value: &Data) -> Option<Parameter> {
    let field = |name| value.field(name);
    let Data::Int(kind) = field("type")? else {
        return None;
    };
    match *kind {
        BOOL => Some(Parameter::Bool(field("bool_value")?.truthy())),
        INTEGER => Some(Parameter::Int(whole(field("integer_value")?)?)),
        DOUBLE => Some(Parameter::Double(field("double_value")?.as_f64()?)),
        STRING => Some(Parameter::String(text(field("string_value")))),
        _ => None,
    }
}

/// A number of 64 bits, which scripts see as a float.
fn whole(data: &Data) -> Option<i64> {
    match data {
        Data::Int(number) => Some(*number),
        // Saturates.
        Data::Float(number) => Some(*number as i64),
        _ => None,
    }
}

fn get(parameters: &mut Parameters, request: &Data) -> Data {
    let values = names(request).map(|name| value_of(parameters.get(&name)));
    Data::map([("values", Data::Array(values.collect()))])
}

fn types(parameters: &mut Parameters, request: &Data) -> Data {
    let types = names(request).map(|name| Data::Int(type_of(parameters.get(&name))));
    Data::map([("types", Data::Array(types.collect()))])
}

/// Something, or why a parameter is not set.
type Checked<T> = std::result::Result<T, String>;

/// The name and the value that a parameter is to have.
fn checked(parameters: &Parameters, parameter: &Data) -> Checked<(String, Parameter)> {
    let name = text(parameter.field("name"));
    let value = parameter.field("value").and_then(read);
    let value = value
        .ok_or_else(|| format!("parameter '{name}' needs a truth value, a number or a string"))?;
    match parameters.get(&name) {
        None => Err(format!("parameter '{name}' is not set by a script")),
        Some(known) if type_of(Some(known)) != type_of(Some(&value)) => {
            Err(format!("parameter '{name}' is of another type"))
        }
        Some(_) => Ok((name, value)),
    }
}

fn outcome(result: Checked<()>) -> Data {
    let reason = result.as_ref().err().cloned().unwrap_or_default();
    Data::map([
        ("successful", Data::Bool(result.is_ok())),
        ("reason", Data::text(&reason)),
    ])
}

fn set(parameters: &mut Parameters, request: &Data) -> Data {
    let set_one = |parameter: &Data| {
        let wanted = checked(parameters, parameter);
        outcome(wanted.map(|(name, value)| drop(parameters.insert(name, value))))
    };
    let results = items(request, "parameters").iter().map(set_one);
    Data::map([("results", Data::Array(results.collect()))])
}

/// All of them, or none.
fn set_atomically(parameters: &mut Parameters, request: &Data) -> Data {
    let wanted = items(request, "parameters").iter();
    let wanted: Checked<Vec<_>> = wanted
        .map(|parameter| checked(parameters, parameter))
        .collect();
    let result = wanted.map(|wanted| parameters.extend(wanted));
    Data::map([("result", outcome(result))])
}

fn describe(parameters: &mut Parameters, request: &Data) -> Data {
    let descriptor = |name: String| {
        let kind = Data::Int(type_of(parameters.get(&name)));
        Data::map([("name", Data::text(&name)), ("type", kind)])
    };
    let descriptors = names(request).map(descriptor).collect();
    Data::map([("descriptors", Data::Array(descriptors))])
}

/// Names that begin with one of the prefixes, up to a depth below it; parts of names are separated by points.
fn list(parameters: &mut Parameters, request: &Data) -> Data {
    let prefixes: Vec<_> = items(request, "prefixes")
        .iter()
        .map(|prefix| text(Some(prefix)))
        .collect();
    let depth = request
        .field("depth")
        .and_then(Data::as_f64)
        .unwrap_or_default();
    let is_near = |rest: &str| depth == 0.0 || (rest.matches('.').count() as f64) < depth;
    let is_listed = |name: &&String| {
        if prefixes.is_empty() {
            return is_near(name);
        }
        let below = |prefix: &String| name.strip_prefix(prefix.as_str())?.strip_prefix('.');
        prefixes
            .iter()
            .any(|prefix| *name == prefix || below(prefix).is_some_and(is_near))
    };
    let listed: Vec<&String> = parameters.keys().filter(is_listed).collect();
    let groups = listed
        .iter()
        .filter_map(|name| Some(name.rsplit_once('.')?.0));
    let groups: BTreeSet<&str> = groups.collect();
    let texts = |names: Vec<&str>| Data::Array(names.into_iter().map(Data::text).collect());
    let result = Data::map([
        (
            "names",
            texts(listed.into_iter().map(String::as_str).collect()),
        ),
        ("prefixes", texts(groups.into_iter().collect())),
    ]);
    Data::map([("result", result)])
}
