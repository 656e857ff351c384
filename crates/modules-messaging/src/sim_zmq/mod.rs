//! The native part of `simZMQ` (`lua/modules/simZMQ.lua`): libzmq, call by call.
//!
//! Only `poll` and `ctx_term` wait, and they end with the program; blocking functions wait in Lua, which can yield.

mod access;
mod contexts;
mod messages;
mod objects;
mod sockets;

use std::ffi::c_int;

use api_macro::api;

use super::{ApiFn, Cx, Module, Result, functions};
use io::zmq::{self, ERRORS};
use objects::objects;
use scene::{Data, Key};
use script::{Bytes, Number, Outside, Param, Table, Text};

pub use objects::has_sockets;

/// The module `simZMQ`.
pub static MODULE: Module = Module {
    about: "ZeroMQ: sockets that carry whole messages between programs.",
    functions: &[
        ("Contexts", contexts::FUNCTIONS),
        ("Sockets", sockets::FUNCTIONS),
        ("Messages", messages::FUNCTIONS),
        ("Errors and encodings", FUNCTIONS),
    ],
    inner: &[INNER, contexts::INNER],
    constants: include_str!("constants.tsv"),
    outside: Outside::AllBut(&[]),
    ..Module::new("simZMQ")
};

const FUNCTIONS: &[ApiFn] = functions![errnum, strerror, has, version, z85_encode, z85_decode];
const INNER: &[ApiFn] = functions![errors, parameters];

/// Numbers beyond C's integers become the nearest.
fn int(number: Number) -> c_int {
    let limit = if number.0 < 0 { c_int::MIN } else { c_int::MAX };
    c_int::try_from(number.0).unwrap_or(limit)
}

/// Why the last call of this script that failed did.
///
/// @return result one of simZMQ's constants, or a number of the system
#[api("simZMQ.errnum")]
fn errnum(cx: &Cx) -> Result<i64> {
    Ok(objects(cx).errno())
}

/// The text of an error.
///
/// @param errnum from simZMQ.errnum
/// @return message
#[api("simZMQ.strerror")]
fn strerror(_cx: &Cx, errnum: Number) -> Result<String> {
    Ok(zmq::strerror(int(errnum)))
}

/// Whether libzmq was built with a capability.
///
/// @param capability its name
/// @return result 1 or 0
#[api("simZMQ.has")]
fn has(_cx: &Cx, capability: String) -> Result<i64> {
    Ok(zmq::has(&capability).into())
}

/// The version of libzmq.
///
/// @return major
/// @return minor
/// @return patch
#[api("simZMQ.version")]
fn version(_cx: &Cx) -> Result<(i64, i64, i64)> {
    let (major, minor, patch) = zmq::version();
    Ok((major.into(), minor.into(), patch.into()))
}

/// Bytes as printable text.
///
/// @param data as many bytes as can be divided by 4
/// @return text nothing for another number of bytes
#[api("simZMQ.z85_encode")]
fn z85_encode(_cx: &Cx, data: Bytes) -> Result<Option<Text>> {
    Ok(zmq::z85_encode(&data.0).map(Text))
}

/// The bytes of a text that simZMQ.z85_encode made.
///
/// @param text the text
/// @return data nothing for another text
#[api("simZMQ.z85_decode")]
fn z85_decode(_cx: &Cx, text: Bytes) -> Result<Option<Text>> {
    Ok(zmq::z85_decode(&text.0).map(Text))
}

/// The names of errors.
///
/// @return errors numbers by name
#[api("simZMQ.errors")]
fn errors(_cx: &Cx) -> Result<Table> {
    let entries = ERRORS
        .iter()
        .map(|&(name, number)| (name.as_bytes().to_vec(), i64::from(number)));
    Ok(Table(Data::Map(
        entries
            .map(|(name, number)| (Key::Text(name), number.into()))
            .collect(),
    )))
}

/// The parameters of the functions for scripts, for the Lua part, which checks them: `string socket, int flags, int max_buf_size?`.
///
/// @return parameters texts by name
#[api("simZMQ.parameters")]
fn parameters(_cx: &Cx) -> Result<Table> {
    let entries = MODULE.public_functions().map(|function| {
        let list: Vec<String> = function.params.iter().map(declaration).collect();
        let name = function.name.trim_start_matches("simZMQ.");
        (
            Key::Text(name.into()),
            Data::Text(list.join(", ").into_bytes()),
        )
    });
    Ok(Table(Data::Map(entries.collect())))
}

fn declaration(param: &Param) -> String {
    let optional = if param.default.is_some() { "?" } else { "" };
    format!("{} {}{optional}", param.ty, param.name)
}
