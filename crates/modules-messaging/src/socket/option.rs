//! `getoption` and `setoption`.

use api_macro::api;

use super::AnySocket;
use super::results::Outcome;
use crate::{ApiFn, Cx, Result, functions};
use io::socket::{self, Failure, OptionValue};
use scene::Data;
use script::{ApiError, LuaString, Results};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![getoption, setoption];

/// Options whose values are numbers; other plain ones are true or false.
const NUMBERS: &[&str] = &[
    "recv-buffer-size",
    "send-buffer-size",
    "tcp-keepidle",
    "tcp-keepcnt",
    "tcp-keepintvl",
    "ip-multicast-ttl",
    "ipv6-multicast-hops",
    "ipv6-unicast-hops",
];
/// Options whose values are strings.
const TEXTS: &[&str] = &["bindtodevice", "ip-multicast-if"];
const BOOLEANS: &[&str] = &[
    "keepalive",
    "reuseaddr",
    "reuseport",
    "broadcast",
    "tcp-nodelay",
    "ipv6-v6only",
    "ip-multicast-loop",
    "ipv6-multicast-loop",
];
/// Options LuaSocket has.
const NOT_BUILT: &[&str] = &[
    "dontroute",
    "tcp-defer-accept",
    "tcp-fastopen",
    "tcp-fastopen-connect",
];

/// Reads an option.
#[api("socket.core.any:getoption")]
fn getoption(_cx: &Cx, object: AnySocket, option: LuaString) -> Result<Outcome<Results>> {
    let name = option.text();
    let Some(socket) = object.socket() else {
        return Ok(failed("getsockopt failed"));
    };
    let value = socket::option(&socket, &name).ok_or_else(|| unsupported(&name))?;
    Ok(match value {
        Ok(value) => Outcome(Ok(Results(vec![data(value)]))),
        Err(_) => failed("getsockopt failed"),
    })
}

fn data(value: OptionValue) -> Data {
    match value {
        OptionValue::Bool(on) => Data::Bool(on),
        OptionValue::Number(number) => Data::Float(number),
        OptionValue::Text(text) => Data::text(&text),
        OptionValue::Linger { on, timeout } => {
            Data::map([("on", Data::Bool(on)), ("timeout", Data::Float(timeout))])
        }
        OptionValue::Error(Some(text)) => Data::text(&text),
        OptionValue::Error(None) | OptionValue::Membership { .. } => Data::Nil,
    }
}

/// Changes an option.
#[api("socket.core.any:setoption")]
fn setoption(
    cx: &Cx,
    object: AnySocket,
    option: LuaString,
    #[default(Data::Nil)] value: Data,
) -> Result<Outcome<f64>> {
    let name = option.text();
    let value = typed(&name, &value)?;
    if let OptionValue::Membership { group, .. } = &value {
        cx.permissions().check_net(group, None)?;
    }
    let Some(socket) = object.socket() else {
        return Ok(failed("setsockopt failed"));
    };
    match socket::set_option(&socket, &name, &value) {
        Some(Ok(())) => Ok(Outcome(Ok(1.0))),
        Some(Err(_)) => Ok(failed("setsockopt failed")),
        None => Err(unsupported(&name)),
    }
}

fn failed<T>(text: &str) -> Outcome<T> {
    Outcome(Err(Failure::words(text)))
}

fn unsupported(name: &str) -> ApiError {
    if NOT_BUILT.contains(&name) {
        return ApiError::NotImplemented(format!("socket option {name}"));
    }
    ApiError::BadArgument {
        position: 2,
        reason: format!("unsupported option `{name}'"),
    }
}

/// The value in the form of the option.
fn typed(name: &str, value: &Data) -> Result<OptionValue> {
    let wrong = |wanted: &str| ApiError::BadArgument {
        position: 3,
        reason: format!("{wanted} expected"),
    };
    match (name, value) {
        (_, Data::Bool(on)) if BOOLEANS.contains(&name) => Ok(OptionValue::Bool(*on)),
        (_, Data::Int(number)) if NUMBERS.contains(&name) => {
            Ok(OptionValue::Number(*number as f64))
        }
        (_, Data::Float(number)) if NUMBERS.contains(&name) => Ok(OptionValue::Number(*number)),
        (_, Data::Text(text)) if TEXTS.contains(&name) => Ok(OptionValue::Text(
            String::from_utf8_lossy(text).into_owned(),
        )),
        ("linger", Data::Map(_)) => Ok(OptionValue::Linger {
            on: field(value, "on") == "true",
            timeout: field(value, "timeout").parse().unwrap_or(0.0),
        }),
        (_, Data::Map(_)) if name.ends_with("-membership") => Ok(OptionValue::Membership {
            group: field(value, "multiaddr"),
            interface: field(value, "interface"),
        }),
        _ if BOOLEANS.contains(&name) => Err(wrong("boolean")),
        _ if NUMBERS.contains(&name) => Err(wrong("number")),
        _ if TEXTS.contains(&name) => Err(wrong("string")),
        _ if name == "linger" || name.ends_with("-membership") => Err(wrong("table")),
        _ => Err(unsupported(name)),
    }
}

/// A field as text; empty when there is none.
fn field(value: &Data, name: &str) -> String {
    match value.field(name) {
        Some(Data::Text(text)) => String::from_utf8_lossy(text).into_owned(),
        Some(Data::Int(number)) => number.to_string(),
        Some(Data::Float(number)) => number.to_string(),
        Some(Data::Bool(on)) => on.to_string(),
        _ => String::new(),
    }
}
