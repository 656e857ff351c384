//! From a Lua value to CBOR, without calling Lua.

use std::ffi::c_int;

use super::{MAX_DEPTH, TOO_DEEP};
use scene::numbers;
use script::{ApiResult, Args, LuaType, Stack, read_buffer};
use wire::cbor_head::{FALSE, NULL, TRUE, is_text, major, push_float, push_head, push_int};

/// Nulls written for holes of one array. Lua's `#` may be astronomic for a table with a few elements.
const MAX_HOLES: i64 = 1 << 16;

/// Bytes of one value: as many as a Lua string may have. A table that holds another many times grows beyond all memory.
const MAX_BYTES: usize = 1 << 29;

/// Why a value was not written.
enum Stop {
    /// It has a metatable, or a type of which Lua decides.
    NeedsLua,
    Bad(&'static str),
}

type Written = Result<(), Stop>;

pub(super) fn encode(args: &mut Args<'_>) -> ApiResult<c_int> {
    let stack = args.stack();
    let mut out = Vec::new();
    if stack.top() == 0 {
        stack.push_nil();
    }
    Ok(match write(stack, 1, &mut out, 0) {
        Ok(()) => {
            stack.push_bytes(&out);
            1
        }
        Err(Stop::NeedsLua) => 0,
        Err(Stop::Bad(message)) => {
            stack.push_nil();
            stack.push_bytes(message.as_bytes());
            2
        }
    })
}

fn write(stack: Stack<'_>, index: c_int, out: &mut Vec<u8>, depth: usize) -> Written {
    match stack.kind(index) {
        LuaType::Nil => out.push(NULL),
        LuaType::Boolean => out.push(if stack.truthy(index) { TRUE } else { FALSE }),
        LuaType::Number => match stack.integer(index) {
            Some(integer) => push_int(out, integer),
            None => push_float(out, stack.number(index).unwrap_or_default()),
        },
        LuaType::String => stack
            .with_bytes(index, |bytes| write_string(out, bytes))
            .unwrap_or(Ok(()))?,
        LuaType::Table => write_table(stack, stack.absolute(index), out, depth)?,
        _ => return Err(Stop::NeedsLua),
    }
    check_size(out.len())
}

fn check_size(size: usize) -> Written {
    if size > MAX_BYTES {
        Err(Stop::Bad("Cannot encode: more than 512 MiB"))
    } else {
        Ok(())
    }
}

fn write_string(out: &mut Vec<u8>, bytes: &[u8]) -> Written {
    write_bytes(
        out,
        if is_text(bytes) {
            major::TEXT
        } else {
            major::BYTES
        },
        bytes,
    )
}

fn write_bytes(out: &mut Vec<u8>, major: u8, bytes: &[u8]) -> Written {
    check_size(out.len() + bytes.len())?;
    push_head(out, major, bytes.len() as u64);
    out.extend_from_slice(bytes);
    Ok(())
}

fn write_table(stack: Stack<'_>, table: c_int, out: &mut Vec<u8>, depth: usize) -> Written {
    if depth >= MAX_DEPTH || !stack.reserve(8) {
        return Err(Stop::Bad(TOO_DEEP));
    }
    if stack.push_metatable(table) {
        stack.pop(1);
        let bytes = read_buffer(stack, table).ok_or(Stop::NeedsLua)?;
        return write_bytes(out, major::BYTES, &bytes);
    }
    match stack.raw_len(table) {
        0 => write_map(stack, table, out, depth),
        len => write_array(stack, table, numbers::count(len), out, depth),
    }
}

fn write_array(
    stack: Stack<'_>,
    table: c_int,
    len: i64,
    out: &mut Vec<u8>,
    depth: usize,
) -> Written {
    push_head(out, major::ARRAY, len.cast_unsigned());
    let mut holes = 0;
    for i in 1..=len {
        if stack.raw_get_index(table, i) == LuaType::Nil {
            holes += 1;
            if holes > MAX_HOLES {
                return Err(Stop::Bad("Cannot encode table: too many holes"));
            }
        }
        write(stack, -1, out, depth + 1)?;
        stack.pop(1);
    }
    Ok(())
}

fn write_map(stack: Stack<'_>, table: c_int, out: &mut Vec<u8>, depth: usize) -> Written {
    let start = out.len();
    let mut count: u64 = 0;
    out.push(major::MAP);
    let mut entries = stack.entries(table);
    while entries.advance() {
        write(stack, entries.key(), out, depth + 1)?;
        write(stack, entries.value(), out, depth + 1)?;
        count += 1;
    }
    // The number of entries is known only now; its place is before them.
    let mut head = Vec::with_capacity(9);
    push_head(&mut head, major::MAP, count);
    match *head {
        [short] => out[start] = short,
        _ => drop(out.splice(start..=start, head)),
    }
    Ok(())
}
