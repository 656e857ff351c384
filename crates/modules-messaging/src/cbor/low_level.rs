//! Heads of CBOR items, for Lua code that assembles items itself.

use std::ffi::c_int;

use scene::numbers;
use script::{ApiError, ApiResult, Args, LuaType, Stack};
use wire::cbor_head::{Head, HeadError, INDEFINITE, major, push_float, push_head};

pub(super) fn encode(args: &mut Args<'_>) -> ApiResult<c_int> {
    args.require(1)?;
    let stack = args.stack();
    let kind = stack
        .integer(1)
        .and_then(|kind| u8::try_from(kind).ok())
        .filter(|kind| kind & 0x1f == 0);
    let kind = kind.ok_or_else(|| {
        ApiError::Other("argument 1 is not a type of CBOR (0x00, 0x20, ... 0xE0).".into())
    })?;
    let mut out = Vec::new();
    match stack.number(3) {
        Some(float) if kind == major::SIMPLE => write_float(&mut out, stack, float)?,
        _ if matches!(stack.kind(2), LuaType::Nil | LuaType::None) => out.push(kind | INDEFINITE),
        _ => push_head(&mut out, kind, count(stack)?),
    }
    stack.push_bytes(&out);
    Ok(1)
}

/// The number of a head: an integer, or a float that is one. Negative integers are those from 2^63 on.
fn count(stack: Stack<'_>) -> ApiResult<u64> {
    let number = match stack.integer(2) {
        Some(integer) => return Ok(integer.cast_unsigned()),
        None => stack.number(2).ok_or(ApiError::NotA {
            position: 2,
            expected: "number",
        })?,
    };
    let fits = number.fract() == 0.0 && (0.0..2f64.powi(64)).contains(&number);
    if fits {
        Ok(number as u64)
    } else {
        Err(ApiError::NotA {
            position: 2,
            expected: "integer",
        })
    }
}

fn write_float(out: &mut Vec<u8>, stack: Stack<'_>, float: f64) -> ApiResult<()> {
    match stack.integer(2) {
        None if matches!(stack.kind(2), LuaType::Nil | LuaType::None) => push_float(out, float),
        Some(25) => {
            push_float(out, float);
            if out.len() != 3 {
                return Err(ApiError::Other("cannot convert to half-precision.".into()));
            }
        }
        Some(26) => {
            out.push(major::SIMPLE | 26);
            out.extend(numbers::single(float).to_be_bytes());
        }
        Some(27) => {
            out.push(major::SIMPLE | 27);
            out.extend(float.to_be_bytes());
        }
        _ => {
            return Err(ApiError::Other(
                "argument 2 is not 25, 26, 27 or nil.".into(),
            ));
        }
    }
    Ok(())
}

pub(super) fn decode(args: &mut Args<'_>) -> ApiResult<c_int> {
    args.require(2)?;
    let stack = args.stack();
    let (head, end) = read_head(stack)?.map_err(|error| ApiError::Other(error.to_string()))?;
    Ok(push_head_read(stack, head, end))
}

/// The same, with nil and a message where there is no head.
pub(super) fn head(args: &mut Args<'_>) -> ApiResult<c_int> {
    args.require(2)?;
    let stack = args.stack();
    Ok(match read_head(stack)? {
        Ok((head, end)) => push_head_read(stack, head, end),
        Err(error) => {
            stack.push_nil();
            stack.push_bytes(error.to_string().as_bytes());
            2
        }
    })
}

/// The head at a position in the string in argument 1.
fn read_head(stack: Stack<'_>) -> ApiResult<Result<(Head, usize), HeadError>> {
    let at = position(stack)?;
    let head = stack.with_bytes(1, |bytes| Head::read(bytes, at.min(bytes.len())));
    head.ok_or(ApiError::NotA {
        position: 1,
        expected: "string",
    })
}

/// The second argument: a position in the first one, which scripts count from 1. It may be beyond the end.
pub(super) fn position(stack: Stack<'_>) -> ApiResult<usize> {
    if stack.kind(1) != LuaType::String {
        return Err(ApiError::NotA {
            position: 1,
            expected: "string",
        });
    }
    let position = stack.integer(2).ok_or(ApiError::NotA {
        position: 2,
        expected: "integer",
    })?;
    Ok(usize::try_from(position.saturating_sub(1)).unwrap_or(usize::MAX))
}

fn push_head_read(stack: Stack<'_>, head: Head, end: usize) -> c_int {
    stack.push_int(i64::from(head.major));
    stack.push_int(i64::from(head.info));
    match head.float() {
        Some(float) => stack.push_number(float),
        None if head.info == INDEFINITE => stack.push_number(f64::INFINITY),
        None => stack.push_int(head.argument.cast_signed()),
    }
    stack.push_int(numbers::count(end) + 1);
    4
}
