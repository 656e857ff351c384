//! The native part of the module `mime`: LuaSocket's low-level filters.
//!
//! Each takes what the call before left undecided, and a chunk (nil at the end); it returns text, and what is undecided now.

use api_macro::api;

use super::{ApiFn, Cx, Module, Result, functions};
use scene::Data;
use scene::numbers;
use script::{LuaNumber, LuaString, Results};
use wire::mime::{
    QuotedPrintable, decode_base64, decode_quoted_printable, encode_base64, finish_base64,
    stuff_dots, unify_line_ends, wrap_quoted_printable, wrap_text,
};

/// The module `mime.core`.
pub static MODULE: Module = Module {
    about: "The low-level filters of mime.",
    functions: &[("Filters", FUNCTIONS)],
    ..Module::new("mime.core")
};

const FUNCTIONS: &[ApiFn] = functions![b64, unb64, qp, unqp, wrp, qpwrp, eol, dot];

/// Length of lines, unless another is given.
const LINE: f64 = 76.0;

/// Nil for empty text: at the end of all chunks nothing is left to say.
fn last(text: Vec<u8>) -> Results {
    let text = if text.is_empty() {
        Data::Nil
    } else {
        Data::Text(text)
    };
    Results(vec![text, Data::Nil])
}

fn pair(text: Vec<u8>, left: &[u8]) -> Results {
    Results(vec![Data::Text(text), Data::Text(left.to_vec())])
}

const NOTHING: [Data; 2] = [Data::Nil, Data::Nil];

/// Base64.
#[api("mime.core.b64")]
fn b64(_cx: &Cx, left: Option<LuaString>, chunk: Option<LuaString>) -> Result<Results> {
    let Some(LuaString(first)) = left else {
        return Ok(Results(NOTHING.into()));
    };
    let (mut text, rest) = encode_base64(&first);
    let Some(LuaString(chunk)) = chunk else {
        return Ok(last((text + &finish_base64(rest)).into_bytes()));
    };
    let both = [rest, &chunk[..]].concat();
    let (more, rest) = encode_base64(&both);
    text += &more;
    Ok(pair(text.into_bytes(), rest))
}

/// Base64, the other way.
#[api("mime.core.unb64")]
fn unb64(_cx: &Cx, left: Option<LuaString>, chunk: Option<LuaString>) -> Result<Results> {
    let Some(LuaString(mut text)) = left else {
        return Ok(Results(NOTHING.into()));
    };
    let is_last = chunk.is_none();
    text.extend(chunk.into_iter().flat_map(|chunk| chunk.0));
    let (bytes, rest) = decode_base64(&text);
    Ok(if is_last {
        last(bytes)
    } else {
        pair(bytes, &rest)
    })
}

/// Quoted-printable.
#[api("mime.core.qp")]
fn qp(
    _cx: &Cx,
    left: Option<LuaString>,
    chunk: Option<LuaString>,
    marker: Option<LuaString>,
) -> Result<Results> {
    let Some(LuaString(first)) = left else {
        return Ok(Results(NOTHING.into()));
    };
    let marker = marker.map_or_else(|| b"\r\n".to_vec(), |marker| marker.0);
    let mut encoder = QuotedPrintable {
        marker: &marker,
        pending: Vec::new(),
    };
    let mut out = Vec::new();
    encoder.encode(&first, &mut out);
    match chunk {
        Some(LuaString(chunk)) => {
            encoder.encode(&chunk, &mut out);
            Ok(pair(out, &encoder.pending))
        }
        None => {
            encoder.finish(&mut out);
            Ok(last(out))
        }
    }
}

/// Quoted-printable, the other way.
#[api("mime.core.unqp")]
fn unqp(_cx: &Cx, left: Option<LuaString>, chunk: Option<LuaString>) -> Result<Results> {
    let Some(LuaString(mut text)) = left else {
        return Ok(Results(NOTHING.into()));
    };
    let is_last = chunk.is_none();
    text.extend(chunk.into_iter().flat_map(|chunk| chunk.0));
    let (bytes, rest) = decode_quoted_printable(&text);
    Ok(if is_last {
        last([&bytes[..], rest].concat())
    } else {
        pair(bytes, rest)
    })
}

type Wrap = fn(&[u8], i64, i64, &mut Vec<u8>) -> i64;

/// Wraps a chunk; at the end, a line that has begun is ended with `end`.
fn wrapped(
    wrap: Wrap,
    end: &[u8],
    left: f64,
    chunk: Option<LuaString>,
    length: Option<LuaNumber>,
) -> Results {
    let length = length.map_or(LINE, |length| length.0);
    let mut out = Vec::new();
    let (text, left) = match chunk {
        Some(LuaString(chunk)) => {
            let left = wrap(
                &chunk,
                numbers::truncated(length),
                numbers::truncated(left),
                &mut out,
            );
            (Data::Text(out), left as f64)
        }
        None if left < length => (Data::Text(end.to_vec()), length),
        None => (Data::Nil, length),
    };
    Results(vec![text, Data::Float(left)])
}

/// Breaks text into lines; the first argument is how much still fits the current one.
#[api("mime.core.wrp")]
fn wrp(
    _cx: &Cx,
    left: LuaNumber,
    chunk: Option<LuaString>,
    length: Option<LuaNumber>,
) -> Result<Results> {
    Ok(wrapped(wrap_text, b"\r\n", left.0, chunk, length))
}

/// Breaks quoted-printable text into lines.
#[api("mime.core.qpwrp")]
fn qpwrp(
    _cx: &Cx,
    left: LuaNumber,
    chunk: Option<LuaString>,
    length: Option<LuaNumber>,
) -> Result<Results> {
    Ok(wrapped(
        wrap_quoted_printable,
        b"=\r\n",
        left.0,
        chunk,
        length,
    ))
}

/// Makes all line ends the same.
#[api("mime.core.eol")]
fn eol(
    _cx: &Cx,
    last: LuaNumber,
    chunk: Option<LuaString>,
    marker: Option<LuaString>,
) -> Result<Results> {
    let Some(LuaString(chunk)) = chunk else {
        return Ok(Results(vec![Data::Nil, Data::Float(0.0)]));
    };
    let marker = marker.map_or_else(|| b"\r\n".to_vec(), |marker| marker.0);
    let mut out = Vec::new();
    let last = unify_line_ends(&chunk, numbers::level(last.0), &marker, &mut out);
    Ok(Results(vec![Data::Text(out), Data::Float(last.into())]))
}

/// Doubles dots at the beginnings of lines, as SMTP wants it.
#[api("mime.core.dot")]
fn dot(_cx: &Cx, seen: LuaNumber, chunk: Option<LuaString>) -> Result<Results> {
    let Some(LuaString(chunk)) = chunk else {
        return Ok(Results(vec![Data::Nil, Data::Float(2.0)]));
    };
    let mut out = Vec::new();
    let seen = stuff_dots(&chunk, numbers::index(seen.0), &mut out);
    Ok(Results(vec![Data::Text(out), Data::Float(seen as f64)]))
}
